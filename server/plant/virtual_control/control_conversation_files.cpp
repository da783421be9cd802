// The part of a session for directories and files, and their transfers.

#include "plant/virtual_control/virtual_control.hpp"

namespace fitgauge::virtual_control {

using namespace control_link;

namespace {

/// The login that files ask for.
constexpr std::string_view kFile = "FILE";
/// The longest file, as over HTTP.
constexpr std::size_t kLongestFile = std::size_t{8} << 20;
/// The bytes of a name in a list, without its letters.
constexpr std::size_t kEntryBytes = sizeof(DiskEntry);
/// Free bytes in the answer to R_DI, independent of the host.
constexpr std::uint32_t kFreeBytes = 0x7FFFFFFF;

/// The byte at the end of a line in a mode that sends lines.
std::string lines_on_the_wire(std::string_view bytes) {
  std::string wire;
  wire.reserve(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const bool is_crlf = bytes[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n';
    if (is_crlf) ++i;
    wire += bytes[i] == '\n' ? '\0' : bytes[i];
  }
  return wire;
}

/// Accepted, or why it was not done.
template <class Done>
ControlResult<std::optional<Telegram>> accepted(const Done& done) {
  if (!done) return done.error();
  return encode(control_link::Accepted{});
}

std::uint32_t unix_time(Timestamp time) {
  return static_cast<std::uint32_t>(time.nanoseconds / 1'000'000'000);
}

}  // namespace

ControlConversation::Reply ControlConversation::reply(const ChangeDirectory& request) {
  TRY(needs({kFile}));
  auto directory = TRY(directory_path(request.path, directory_));
  if (!state_.disk.has_directory(directory)) return ControlError::NoDirectory;
  directory_ = std::move(directory);
  return encode(control_link::Accepted{});
}

ControlConversation::Reply ControlConversation::reply(const ReadDirectory&) {
  TRY(needs({kFile}));
  if (!state_.disk.has_directory(directory_)) return ControlError::NoDirectory;
  return encode(DirectoryInformation{.free_bytes = kFreeBytes, .path = directory_});
}

DirectoryEntry ControlConversation::listed(const DiskEntry& entry) const {
  const std::uint32_t directory =
      state_.model.is_itnc ? FileInformation::kDirectoryOfItnc : FileInformation::kDirectory;
  return {.bytes = static_cast<std::uint32_t>(entry.size),
          .unix_time = unix_time(entry.modified_at),
          .flags = entry.is_directory ? directory : FileInformation::kChangeable,
          .name = entry.name};
}

ControlConversation::Reply ControlConversation::reply(const ListDirectory& request) {
  TRY(needs({kFile}));
  Sending sending{.share = ByteShare(state_.transfers)};
  if (request.mode == ListDirectory::kDrives) {
    sending.entries.push_back({.name = "TNC:", .is_directory = true});
  } else if (request.mode == ListDirectory::kEntries) {
    auto entries = TRY(state_.disk.list(directory_));
    std::size_t bytes = 0;
    for (const DiskEntry& entry : entries) bytes += kEntryBytes + entry.name.size();
    if (!sending.share.take(bytes)) return ControlError::NoSpace;
    sending.entries = std::move(entries);
  } else {
    return ControlError::WrongParameter;
  }
  transfer_ = std::move(sending);
  return reply(control_link::Accepted{});
}

ControlConversation::Reply ControlConversation::reply(const MakeDirectory& request) {
  TRY(needs_to_write(kFile));
  const auto directory = TRY(directory_path(request.path, directory_));
  return accepted(state_.disk.make_directory(directory));
}

ControlConversation::Reply ControlConversation::reply(const DeleteDirectory& request) {
  TRY(needs_to_write(kFile));
  const auto directory = TRY(directory_path(request.path, directory_));
  if (!state_.model.is_itnc && ascii_iequals(directory, directory_)) return ControlError::InUse;
  return accepted(state_.disk.remove_directory(directory));
}

ControlConversation::Reply ControlConversation::reply(const ReadFileInformation& request) {
  TRY(needs({kFile}));
  DiskEntry entry;
  const auto directory = directory_path(request.path, directory_);
  if (directory && state_.disk.has_directory(*directory)) {
    entry = {.name = *directory, .is_directory = true};
  } else {
    const auto path = file_path(request.path, directory_);
    if (!path) return ControlError::NoFile;
    entry = TRY(state_.disk.find(*path));
  }
  const DirectoryEntry shown = listed(entry);
  return encode(FileInformation{shown.bytes, shown.unix_time, shown.flags, shown.name});
}

ControlConversation::Reply ControlConversation::reply(const DeleteFile& request) {
  TRY(needs_to_write(kFile));
  const auto path = TRY(file_path(request.path, directory_));
  return accepted(state_.disk.remove(path));
}

ControlConversation::Reply ControlConversation::copy(const std::string& source,
                                                     const std::string& target, bool moves) {
  TRY(needs_to_write(kFile));
  const auto from = TRY(file_path(source, directory_));
  const auto to = TRY(file_path(target, directory_));
  return accepted(moves ? state_.disk.rename(from, to) : state_.disk.copy(from, to));
}

ControlConversation::Reply ControlConversation::reply(const Upload& request) {
  TRY(needs_to_write(kFile));
  auto path = TRY(file_path(request.path, directory_));
  if (!state_.disk.has_directory(path.directory())) return ControlError::NoDirectory;
  transfer_ = Receiving{.path = std::move(path),
                        .binary = request.binary.value_or(false),
                        .bytes = {},
                        .share = ByteShare(state_.transfers)};
  return encode(control_link::Accepted{});
}

ControlConversation::Reply ControlConversation::reply(const FileBlock& block) {
  auto* const receiving = std::get_if<Receiving>(&transfer_);
  if (receiving == nullptr) return ControlError::Unexpected;
  const std::string& bytes = block.bytes.value;
  if (receiving->bytes.size() + bytes.size() > kLongestFile ||
      !receiving->share.take(bytes.size())) {
    return ControlError::NoSpace;
  }
  receiving->bytes += bytes;
  return encode(control_link::Accepted{});
}

ControlConversation::Reply ControlConversation::reply(const EndOfData&) {
  auto* const receiving = std::get_if<Receiving>(&transfer_);
  if (receiving == nullptr) return ControlError::Unexpected;
  std::string& bytes = receiving->bytes;
  if (!receiving->binary) std::ranges::replace(bytes, '\0', '\n');
  const auto written = state_.disk.write(receiving->path, bytes);
  transfer_ = std::monostate();
  if (!acknowledges_end_) return std::optional<Telegram>();
  return accepted(written);
}

ControlConversation::Reply ControlConversation::reply(const Download& request) {
  TRY(needs({kFile}));
  const auto path = TRY(file_path(request.path, directory_));
  const auto bytes = TRY(state_.disk.read(path));
  Sending sending{.is_file = true, .share = ByteShare(state_.transfers)};
  if (!sending.share.take(bytes->size())) return ControlError::NoSpace;
  sending.bytes = request.binary.value_or(false) ? *bytes : lines_on_the_wire(*bytes);
  transfer_ = std::move(sending);
  return reply(control_link::Accepted{});
}

/// The next part of a transfer; of an empty file one empty block.
ControlConversation::Reply ControlConversation::reply(const control_link::Accepted&) {
  auto* const sending = std::get_if<Sending>(&transfer_);
  if (sending == nullptr) return ControlError::Unexpected;
  const std::size_t sent = sending->sent;
  if (sending->is_file && (sent < sending->bytes.size() || sent == 0)) {
    // A block is ten bytes shorter than the buffer, as other controls send it.
    std::string block = sending->bytes.substr(sent, buffer_ - kHeadBytes - 2);
    sending->sent += std::max<std::size_t>(block.size(), 1);
    return encode(FileBlock{.bytes = {std::move(block)}});
  }
  if (!sending->is_file && sent < sending->entries.size()) {
    return encode(listed(sending->entries[sending->sent++]));
  }
  transfer_ = std::monostate();
  return encode(EndOfData{});
}

ControlConversation::Reply ControlConversation::dump_screen(const std::string& path) {
  TRY(needs_to_write(kFile));
  const auto file = TRY(file_path(path, directory_));
  return accepted(state_.disk.write(file, screen_dump(state_.machine.state())));
}

}  // namespace fitgauge::virtual_control
