#include "plant/lsv2/link/link_client.hpp"

namespace fitgauge::control_link {
namespace {

using Kind = LinkFailure::Kind;

/// The buffers that C_CC can ask for, the largest first.
struct BufferCommand {
  std::size_t bytes;
  std::uint16_t command;
};
constexpr std::array kBuffers{BufferCommand{4096, 7}, BufferCommand{3072, 6},
                              BufferCommand{2048, 5}, BufferCommand{1024, 3},
                              BufferCommand{512, 4}};

/// A block is shorter than the buffer by these bytes, as in other peers.
constexpr std::size_t kBlockHead = kHeadBytes + 2;

}  // namespace

std::string_view refusal_text(std::uint8_t code) {
  switch (static_cast<ControlError>(code)) {
    case ControlError::BadFormat: return "the telegram is malformed";
    case ControlError::Unexpected: return "the telegram is out of order";
    case ControlError::UnknownTelegram: return "unknown telegram";
    case ControlError::NoPrivilege: return "the login does not allow this";
    case ControlError::WrongParameter: return "unknown parameter";
    case ControlError::BadFileName: return "the path is not a path of a control, or is too long";
    case ControlError::NoFile: return "file not found";
    case ControlError::FileExists: return "the file exists";
    case ControlError::InUse: return "it is in use";
    case ControlError::NoLogin: return "the control does not allow this login";
    case ControlError::BadAddress: return "address not found";
    case ControlError::NoSpace: return "the disk is full, or the file is too long";
    case ControlError::DirectoryNotEmpty: return "the directory is not empty";
    case ControlError::NoDirectory: return "directory not found";
    case ControlError::WrongMode: return "the control is in the wrong mode of operation";
    case ControlError::NoNextError: return "no further error";
    case ControlError::NoWriteAccess: return "the file is read-only";
    case ControlError::Failed: return "it failed";
  }
  return "unknown reason";
}

LinkResult<LinkClient> LinkClient::connect(LinkClientOptions options) {
  auto socket = TRY(LinkSocket::connect(std::move(options)));
  return LinkClient(std::move(socket));
}

LinkFailure LinkClient::unexpected(const Telegram& telegram) const {
  return {Kind::Broken, fmt::format("{} answers with {}, which does not belong to the request",
                                    to_text(socket_.address()), word(telegram.name))};
}

LinkResult<Telegram> LinkClient::ask_telegram(const Telegram& request) {
  if (kHeadBytes + request.payload.size() >= buffer_) {
    return LinkFailure(
        Kind::Refused,
        fmt::format("{} bytes are too long for a telegram of {}", request.payload.size(), buffer_),
        static_cast<std::uint8_t>(ControlError::BadFileName));
  }
  TRY(socket_.send(request));
  auto answer = socket_.receive();
  if (!answer || answer->name != Refused::kName) return answer;
  const auto refused = decode<Refused>(*answer);
  if (!refused) return unexpected(*answer);
  return LinkFailure(Kind::Refused,
                     fmt::format("the control refuses with code {}: {}", refused->code,
                                 refusal_text(refused->code)),
                     refused->code);
}

LinkResult<void> LinkClient::login(std::string_view name) {
  auto done = tell(Login{.name = std::string(name)});
  if (done || done.error().kind != Kind::Refused) return done;
  return LinkFailure(Kind::Refused,
                     fmt::format("login {}: {}; check that the control has the option and that the "
                                 "machine builder allows it",
                                 name, done.error().message),
                     done.error().code);
}

LinkResult<ControlIdentity> LinkClient::identity() {
  const auto versions = TRY(ask<Versions>(ReadVersion{}));
  ControlIdentity identity;
  PayloadReader texts(versions.texts.value);
  texts.get(identity.control);
  texts.get(identity.nc_software);
  texts.get(identity.plc);
  return identity;
}

LinkResult<void> LinkClient::agree_buffer() {
  const auto parameters = ask<Parameters>(ReadParameters{});
  if (!parameters) {
    if (parameters.error().kind == Kind::Refused) return {};
    return parameters.error();
  }
  for (const auto& [bytes, command] : kBuffers) {
    if (bytes > parameters->largest_buffer) continue;
    const auto agreed = tell(SystemCommand{.command = command});
    if (agreed) {
      buffer_ = bytes;
      return {};
    }
    if (agreed.error().kind != Kind::Refused) return agreed;
  }
  return {};
}

LinkResult<std::vector<DirectoryEntry>> LinkClient::list(const std::string& directory,
                                                         std::size_t most) {
  TRY(tell(ChangeDirectory{directory}));
  std::vector<DirectoryEntry> entries;
  auto answer = ask_telegram(encode(ListDirectory{}));
  for (; answer && answer->name == DirectoryEntry::kName;
       answer = ask_telegram(encode(Accepted{}))) {
    auto entry = decode<DirectoryEntry>(*answer);
    if (!entry) return unexpected(*answer);
    if (entries.size() == most) {
      return LinkFailure(Kind::Unfit, fmt::format("{} has more than {} entries", directory, most));
    }
    entries.push_back(*std::move(entry));
  }
  if (!answer) return answer.error();
  if (answer->name != EndOfData::kName) return unexpected(*answer);
  return entries;
}

LinkResult<FileInformation> LinkClient::file_information(const std::string& path) {
  return ask<FileInformation>(ReadFileInformation{path});
}

LinkResult<std::string> LinkClient::download(const std::string& path, Transfer transfer,
                                             std::size_t most) {
  std::string bytes;
  auto answer =
      ask_telegram(encode(Download{.path = path, .binary = transfer == Transfer::Binary}));
  for (; answer && answer->name == FileBlock::kName; answer = ask_telegram(encode(Accepted{}))) {
    if (bytes.size() + answer->payload.size() > most) {
      return LinkFailure(Kind::Unfit, fmt::format("{} is longer than {} bytes", path, most));
    }
    bytes += answer->payload;
  }
  if (!answer) return answer.error();
  if (answer->name != EndOfData::kName) return unexpected(*answer);
  if (transfer == Transfer::Lines) std::replace(bytes.begin(), bytes.end(), '\0', '\n');
  return bytes;
}

LinkResult<void> LinkClient::upload(const std::string& path, std::string_view bytes,
                                    Transfer transfer) {
  std::string wire(bytes);
  if (transfer == Transfer::Lines) {
    if (wire.find('\0') != std::string::npos) {
      return LinkFailure(Kind::Unfit, path + ": a text file must not have a NUL character");
    }
    std::erase(wire, '\r');
    std::replace(wire.begin(), wire.end(), '\n', '\0');
  }
  // Without it the end is not answered, and whether the file was stored is not known.
  const auto acknowledged = tell(SystemCommand{.command = SystemCommand::kAcknowledgeEnd});
  if (!acknowledged && acknowledged.error().kind != Kind::Refused) return acknowledged;
  TRY(tell(Upload{.path = path, .binary = transfer == Transfer::Binary}));
  const std::size_t step = buffer_ - kBlockHead;
  for (std::size_t at = 0; at < wire.size(); at += step)
    TRY(tell(FileBlock{.bytes = {wire.substr(at, step)}}));
  if (acknowledged) return tell(EndOfData{});
  TRY(socket_.send(encode(EndOfData{})));
  TRY(file_information(path));
  return {};
}

}  // namespace fitgauge::control_link
