#pragma once

#include "plant/lsv2/link/link_server.hpp"
#include "plant/virtual_control/machine_view.hpp"
#include "plant/virtual_control/virtual_control.hpp"
#include "plant/virtual_control/virtual_disk.hpp"

namespace fitgauge::virtual_control {

using namespace control_link;

/// State that all clients share.
struct ControlState {
  const ControlModel& model;
  bool is_writable = false;
  VirtualDisk disk;
  MachineView machine;
  std::size_t transfers = std::size_t{24} << 20;    ///< bytes left for those of all clients
  std::map<std::string, std::string> parameters{};  ///< of the machine, by name
};

/// One client's logins, directory and transfer. A telegram without its login is NoPrivilege; one
/// that changes something is NoWriteAccess at a control that is only read.
class ControlConversation final : public Conversation {
 public:
  /// @param state outlives it.
  explicit ControlConversation(ControlState& state) : state_(state) {}
  ~ControlConversation() override { end_transfer(); }

  std::optional<Telegram> answer(const Telegram& telegram) override {
    const auto request = read_request(telegram);
    if (!request) return refusal(request.error());
    // A transfer ends with the first foreign telegram.
    const bool is_of_transfer = std::holds_alternative<FileBlock>(*request) ||
                                std::holds_alternative<EndOfData>(*request) ||
                                std::holds_alternative<control_link::Accepted>(*request);
    if (!is_of_transfer) end_transfer();
    const Reply replied =
        std::visit([this](const auto& message) { return reply(message); }, *request);
    if (!replied) {
      end_transfer();
      return refusal(replied.error());
    }
    // An answer with a path that is longer than the buffer cannot be sent.
    if (*replied && kHeadBytes + (*replied)->payload.size() >= buffer_) {
      return refusal(ControlError::BadFileName);
    }
    return *replied;
  }

  std::size_t buffer() const override { return buffer_; }

 private:
  /// A response; none if the protocol has no response.
  using Reply = ControlResult<std::optional<Telegram>>;
  /// A file that a client sends, from C_FL to T_FD.
  struct Receiving {
    ControlPath path;
    bool binary;
    std::string bytes{};
  };
  /// Answers R_FL and R_DR: makes the next part for each T_OK; none after the last.
  using Sending = std::function<std::optional<Telegram>()>;

  /// The login that files need.
  static constexpr std::string_view kFile = "FILE";
  /// The longest file in bytes; the limit is the one of files over HTTP.
  static constexpr std::size_t kLongestFile = std::size_t{8} << 20;

  Reply reply(const Login& login) {
    constexpr std::string_view kFree[] = {"INSPECT", "FILE", "MONITOR", "DNC", "PLCDEBUG", "DATA"};
    const bool may = std::ranges::find(kFree, login.name) != std::end(kFree) ||
                     (login.name == "FILEPLC" &&
                      (!state_.model.asks_plc_password || login.password == "807667"));
    if (!may) return ControlError::NoLogin;
    logins_.insert(login.name);
    return accepted();
  }

  Reply reply(const Logout& logout) {
    logout.name ? void(logins_.erase(*logout.name)) : logins_.clear();
    return accepted();
  }

  Reply reply(const ReadVersion& request) {
    TRY(needs({"INSPECT"}));
    const ControlModel& model = state_.model;
    std::vector<std::string> texts{std::string(model.name), std::string(model.nc_software),
                                   std::string(kVirtualPlc), "0000000000000000"};
    if (!request.which) {
      if (model.is_itnc) texts.insert(texts.end() - 1, std::string(kVirtualPlc));
      PayloadWriter all;
      for (const std::string& text : texts) all.put(text);
      return encode(Versions{.texts = {std::move(all).bytes()}});
    }
    texts.emplace_back("fitgauge");
    if (!model.is_itnc) texts.emplace_back("R");
    if (*request.which == 0 || *request.which > texts.size()) return ControlError::WrongParameter;
    return encode(Version{texts[*request.which - 1U]});
  }

  Reply reply(const ReadParameters&) {
    TRY(needs({"INSPECT"}));
    return encode(kControlParameters);
  }
  Reply reply(const ReadSystemInformation&) { return ControlError::WrongParameter; }

  Reply reply(const SystemCommand& request) {
    const auto* const agreed =
        std::ranges::find(kBufferCommands, request.command, &BufferCommand::command);
    if (agreed != kBufferCommands.end()) {
      buffer_ = agreed->bytes;
    } else if (request.command == SystemCommand::kAcknowledgeEnd) {
      acknowledges_end_ = true;
    } else if (request.command == SystemCommand::kScreenDump && request.argument) {
      TRY(needs_to_write(kFile));
      const auto file = TRY(file_path(*request.argument, directory_));
      return accepted(state_.disk.write(file, screen_dump(state_.machine.state())));
    } else {
      return ControlError::WrongParameter;
    }
    return accepted();
  }

  Reply reply(const ChangeDirectory& request) {
    TRY(needs({kFile}));
    auto directory = TRY(directory_path(request.path, directory_));
    if (!state_.disk.has_directory(directory)) return ControlError::NoDirectory;
    directory_ = std::move(directory);
    return accepted();
  }

  Reply reply(const ReadDirectory&) {
    TRY(needs({kFile}));
    if (!state_.disk.has_directory(directory_)) return ControlError::NoDirectory;
    constexpr std::uint32_t kFreeBytes = 0x7FFFFFFF;  // independent of the host
    return encode(DirectoryInformation{.free_bytes = kFreeBytes, .path = directory_});
  }

  Reply reply(const ListDirectory& request) {
    TRY(needs({kFile}));
    std::vector<DiskEntry> entries{{.name = "TNC:", .is_directory = true}};
    if (request.mode == ListDirectory::kEntries) {
      entries = TRY(state_.disk.list(directory_));
      std::size_t bytes = entries.size() * sizeof(DiskEntry);
      for (const DiskEntry& entry : entries) bytes += entry.name.size();
      TRY(charge(bytes));
    } else if (request.mode != ListDirectory::kDrives) {
      return ControlError::WrongParameter;
    }
    auto next_entry = [this, entries = std::move(entries),
                       sent = std::size_t{0}]() mutable -> std::optional<Telegram> {
      if (sent == entries.size()) return std::nullopt;
      return encode(shown<DirectoryEntry>(entries[sent++]));
    };
    return begin_sending(std::move(next_entry));
  }

  Reply reply(const MakeDirectory& request) {
    TRY(needs_to_write(kFile));
    const auto directory = TRY(directory_path(request.path, directory_));
    return accepted(state_.disk.make_directory(directory));
  }

  Reply reply(const DeleteDirectory& request) {
    TRY(needs_to_write(kFile));
    const auto directory = TRY(directory_path(request.path, directory_));
    if (!state_.model.is_itnc && ascii_iequals(directory, directory_)) return ControlError::InUse;
    return accepted(state_.disk.remove_directory(directory));
  }

  Reply reply(const ReadFileInformation& request) {
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
    return encode(shown<FileInformation>(entry));
  }

  Reply reply(const DeleteFile& request) {
    TRY(needs_to_write(kFile));
    const auto path = TRY(file_path(request.path, directory_));
    return accepted(state_.disk.remove(path));
  }

  Reply reply(const CopyFile& request) { return copy(request.source, request.target, false); }
  Reply reply(const RenameFile& request) { return copy(request.source, request.target, true); }
  Reply copy(const std::string& source, const std::string& target, bool moves) {
    TRY(needs_to_write(kFile));
    const auto from = TRY(file_path(source, directory_));
    const auto to = TRY(file_path(target, directory_));
    return accepted(state_.disk.copy(from, to, moves));
  }

  Reply reply(const Upload& request) {
    TRY(needs_to_write(kFile));
    auto path = TRY(file_path(request.path, directory_));
    if (!state_.disk.has_directory(path.directory())) return ControlError::NoDirectory;
    transfer_ = Receiving{.path = std::move(path), .binary = request.binary.value_or(false)};
    return accepted();
  }

  Reply reply(const FileBlock& block) {
    auto* const receiving = std::get_if<Receiving>(&transfer_);
    if (receiving == nullptr) return ControlError::Unexpected;
    const std::string& bytes = block.bytes.value;
    if (receiving->bytes.size() + bytes.size() > kLongestFile) return ControlError::NoSpace;
    TRY(charge(bytes.size()));
    receiving->bytes += bytes;
    return accepted();
  }

  Reply reply(const EndOfData&) {
    auto* const receiving = std::get_if<Receiving>(&transfer_);
    if (receiving == nullptr) return ControlError::Unexpected;
    if (!receiving->binary) std::ranges::replace(receiving->bytes, '\0', '\n');
    const auto written = state_.disk.write(receiving->path, receiving->bytes);
    end_transfer();
    if (!acknowledges_end_) return std::optional<Telegram>();
    return accepted(written);
  }

  Reply reply(const Download& request) {
    TRY(needs({kFile}));
    const auto path = TRY(file_path(request.path, directory_));
    const auto stored = TRY(state_.disk.read(path));
    TRY(charge(stored.size()));
    const bool is_binary = request.binary.value_or(false);
    auto next_block = [this, bytes = is_binary ? stored : lines_on_the_wire(stored),
                       sent = std::size_t{0}]() mutable -> std::optional<Telegram> {
      if (sent > 0 && sent >= bytes.size()) return std::nullopt;  // an empty file has one block
      // A block is ten bytes shorter than the buffer, as other controls send it.
      std::string block = bytes.substr(sent, buffer_ - kHeadBytes - 2);
      sent += std::max<std::size_t>(block.size(), 1);
      return encode(FileBlock{.bytes = {std::move(block)}});
    };
    return begin_sending(std::move(next_block));
  }

  /// Sends the next part of a transfer.
  Reply reply(const control_link::Accepted&) {
    auto* const next_part = std::get_if<Sending>(&transfer_);
    if (next_part == nullptr) return ControlError::Unexpected;
    if (auto part = (*next_part)()) return part;
    end_transfer();
    return encode(EndOfData{});
  }

  Reply begin_sending(Sending sending) {
    transfer_ = std::move(sending);
    return reply(control_link::Accepted{});
  }

  Reply reply(const ReadRunInformation& request) {
    TRY(needs({"DNC", "MONITOR"}));
    MachineView& machine = state_.machine;
    switch (request.which) {
      case ReadRunInformation::kAxes: return encode(machine.axes());
      case ReadRunInformation::kMode:
        return encode(State{static_cast<std::uint16_t>(machine.mode())});
      case ReadRunInformation::kProgram: return encode(machine.program());
      case ReadRunInformation::kOverride: return encode(Overrides{10'000, 10'000, 10'000});
      case ReadRunInformation::kState:
        return encode(State{static_cast<std::uint16_t>(machine.state())});
      case ReadRunInformation::kFirstError:
      case ReadRunInformation::kNextError:
        return next_error(request.which == ReadRunInformation::kFirstError);
      case ReadRunInformation::kTool:
        if (!state_.model.is_itnc) return ControlError::WrongParameter;
        return encode(machine.tool());
      default: return ControlError::WrongParameter;
    }
  }

  Reply next_error(bool first) {
    if (first) next_error_ = 0;
    const auto errors = state_.machine.errors();
    if (next_error_ >= errors.size()) return ControlError::NoNextError;
    const interpreter::RunMessage& error = errors[next_error_++];
    // A telegram is not longer than its buffer, so a long text is cut.
    constexpr std::size_t kLongestText = 200;
    return encode(Fault{.number = error.number,
                        .text = std::string(first_characters(error.text, kLongestText))});
  }

  Reply reply(const ReadMemory& request) {
    TRY(needs({"PLCDEBUG"}));
    if (request.address > kMemoryEnd - request.count) return ControlError::BadAddress;
    return encode(Memory{.bytes = {std::string(request.count, '\0')}});
  }

  Reply reply(const ReadMachineParameter& request) {
    TRY(needs({"INSPECT"}));
    if (request.name == kRunParameter)
      return encode(MachineParameter{state_.machine.program().main});
    const auto found = state_.parameters.find(request.name);
    if (found == state_.parameters.end()) return ControlError::WrongParameter;
    return encode(MachineParameter{found->second});
  }

  Reply reply(const WriteMachineParameter& request) {
    TRY(needs_to_write("PLCDEBUG"));
    if (request.name == kRunParameter) {
      if (!request.value.empty()) {
        const auto program = TRY(file_path(request.value, directory_));
        return accepted(state_.machine.start(program));
      }
      state_.machine.stop();
      return accepted();
    }
    const auto found = state_.parameters.find(request.name);
    if (found == state_.parameters.end()) return ControlError::WrongParameter;
    found->second = request.value;
    return accepted();
  }

  Reply reply(const LockKeyboard&) {
    TRY(needs_to_write("MONITOR"));
    return accepted();
  }

  /// The keys of the operating modes switch the mode; every other key is accepted without effect.
  Reply reply(const PressKey& request) {
    TRY(needs_to_write("MONITOR"));
    constexpr std::pair<std::uint16_t, Mode> kKeys[] = {{0x01C0, Mode::Manual},
                                                        {0x01C2, Mode::SingleBlock},
                                                        {0x01C3, Mode::Automatic},
                                                        {0x01C5, Mode::Manual}};  // handwheel
    for (const auto& [key, mode] : kKeys) {
      if (key == request.key) state_.machine.set_mode(mode);
    }
    return accepted();
  }

  Reply reply(const ReadDataPath& request) {
    if (!state_.model.is_itnc) return ControlError::UnknownTelegram;
    TRY(needs({"DATA"}));
    const auto value = TRY(read_data_path(request.path));
    return encode(value);
  }

  /// The answer to what was done: T_OK, or the reason why it was not.
  static Reply accepted(const ControlResult<void>& done = {}) {
    if (!done) return done.error();
    return encode(control_link::Accepted{});
  }

  template <class Entry>
  Entry shown(const DiskEntry& entry) const {
    const std::uint32_t directory =
        state_.model.is_itnc ? Entry::kDirectoryOfItnc : Entry::kDirectory;
    return {.bytes = static_cast<std::uint32_t>(entry.size),
            .unix_time =
                static_cast<std::uint32_t>(entry.modified_at.nanoseconds / kNanosecondsPerSecond),
            .flags = entry.is_directory ? directory : Entry::kChangeable,
            .name = entry.name};
  }

  /// Takes these bytes for the transfer from those of all clients. @errors NoSpace.
  ControlResult<void> charge(std::size_t bytes) {
    if (bytes > state_.transfers) return ControlError::NoSpace;
    state_.transfers -= bytes;
    charged_ += bytes;
    return {};
  }
  void end_transfer() {
    transfer_ = std::monostate();
    state_.transfers += std::exchange(charged_, 0);
  }

  /// @errors NoPrivilege unless one of them is logged in.
  ControlResult<void> needs(std::initializer_list<std::string_view> logins) const {
    const bool has_one = std::ranges::any_of(
        logins, [this](std::string_view login) { return logins_.contains(login); });
    return has_one ? ControlResult<void>() : ControlError::NoPrivilege;
  }
  /// @errors NoPrivilege, NoWriteAccess.
  ControlResult<void> needs_to_write(std::string_view login) const {
    TRY(needs({login}));
    if (!state_.is_writable) return ControlError::NoWriteAccess;
    return {};
  }

  ControlState& state_;
  std::size_t buffer_ = kSmallestBuffer;
  bool acknowledges_end_ = false;
  std::set<std::string, std::less<>> logins_;
  std::string directory_{kRoot};
  std::variant<std::monostate, Receiving, Sending> transfer_;
  std::size_t charged_ = 0;  ///< bytes of the transfer
  std::size_t next_error_ = 0;
};

}  // namespace fitgauge::virtual_control
