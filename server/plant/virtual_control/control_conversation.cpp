#include "plant/virtual_control/virtual_control.hpp"

namespace fitgauge::virtual_control {

using namespace control_link;

namespace {

constexpr std::string_view kFilePlc = "FILEPLC";
constexpr std::string_view kPlcPassword = "807667";
constexpr std::string_view kFreeLogins[] = {"INSPECT", "FILE",     "MONITOR",
                                            "DNC",     "PLCDEBUG", "DATA"};

std::optional<std::size_t> agreed_buffer(std::uint16_t command) {
  switch (command) {
    case 3: return 1024;
    case 4: return 512;
    case 5: return 2048;
    case 6: return 3072;
    case 7: return 4096;
    default: return std::nullopt;
  }
}

}  // namespace

std::optional<Telegram> ControlConversation::answer(const Telegram& telegram) {
  const auto request = read_request(telegram);
  if (!request) return refusal(request.error());
  // A transfer ends with the first foreign telegram.
  const bool is_of_transfer = std::holds_alternative<FileBlock>(*request) ||
                              std::holds_alternative<EndOfData>(*request) ||
                              std::holds_alternative<Accepted>(*request);
  if (!is_of_transfer) transfer_ = std::monostate();
  const Reply replied =
      std::visit([this](const auto& message) { return reply(message); }, *request);
  if (!replied) {
    transfer_ = std::monostate();
    return refusal(replied.error());
  }
  // A long path that does not fit in the smallest buffer has no answer.
  if (*replied && kHeadBytes + (*replied)->payload.size() >= buffer_) {
    return refusal(ControlError::BadFileName);
  }
  return *replied;
}

ControlResult<void> ControlConversation::needs(
    std::initializer_list<std::string_view> logins) const {
  const bool has_one = std::ranges::any_of(
      logins, [this](std::string_view login) { return logins_.contains(login); });
  if (!has_one) return ControlError::NoPrivilege;
  return {};
}

ControlResult<void> ControlConversation::needs_to_write(std::string_view login) const {
  TRY(needs({login}));
  if (!state_.is_writable) return ControlError::NoWriteAccess;
  return {};
}

ControlConversation::Reply ControlConversation::reply(const Login& login) {
  const bool is_free = std::ranges::find(kFreeLogins, login.name) != std::end(kFreeLogins);
  const bool may = is_free || (login.name == kFilePlc &&
                               (!state_.model.asks_plc_password || login.password == kPlcPassword));
  if (!may) return ControlError::NoLogin;
  logins_.insert(login.name);
  return encode(control_link::Accepted{});
}

ControlConversation::Reply ControlConversation::reply(const Logout& logout) {
  if (logout.name) {
    logins_.erase(*logout.name);
  } else {
    logins_.clear();
  }
  return encode(control_link::Accepted{});
}

ControlConversation::Reply ControlConversation::reply(const ReadVersion& request) {
  TRY(needs({"INSPECT"}));
  const ControlModel& model = state_.model;
  const std::string name(model.name);
  const std::string software(model.nc_software);
  const std::string plc(kVirtualPlc);
  const std::string options = "0000000000000000";
  if (!request.which) {
    PayloadWriter texts;
    for (const std::string& text : {name, software, plc}) texts.put(text);
    if (model.is_itnc) texts.put(plc);
    texts.put(options);
    return encode(Versions{.texts = {std::move(texts).bytes()}});
  }
  switch (*request.which) {
    case 1: return encode(Version{name});
    case 2: return encode(Version{software});
    case 3: return encode(Version{plc});
    case 4: return encode(Version{options});
    case 5: return encode(Version{"fitgauge"});
    case 6:
      if (model.is_itnc) return ControlError::WrongParameter;
      return encode(Version{"R"});
    default: return ControlError::WrongParameter;
  }
}

ControlConversation::Reply ControlConversation::reply(const SystemCommand& request) {
  if (const auto buffer = agreed_buffer(request.command)) {
    buffer_ = *buffer;
  } else if (request.command == SystemCommand::kAcknowledgeEnd) {
    acknowledges_end_ = true;
  } else if (request.command == SystemCommand::kScreenDump && request.argument) {
    return dump_screen(*request.argument);
  } else {
    return ControlError::WrongParameter;
  }
  return encode(control_link::Accepted{});
}

ControlConversation::Reply ControlConversation::reply(const ReadRunInformation& request) {
  TRY(needs({"DNC", "MONITOR"}));
  MachineView& machine = state_.machine;
  constexpr std::uint32_t kFullSpeed = 10'000;
  switch (request.which) {
    case ReadRunInformation::kAxes: return encode(machine.axes());
    case ReadRunInformation::kMode:
      return encode(State{static_cast<std::uint16_t>(machine.mode())});
    case ReadRunInformation::kProgram: return encode(machine.program());
    case ReadRunInformation::kOverride:
      return encode(Overrides{kFullSpeed, kFullSpeed, kFullSpeed});
    case ReadRunInformation::kState:
      return encode(State{static_cast<std::uint16_t>(machine.state())});
    case ReadRunInformation::kFirstError: return next_error(true);
    case ReadRunInformation::kNextError: return next_error(false);
    case ReadRunInformation::kTool:
      if (!state_.model.is_itnc) return ControlError::WrongParameter;
      return encode(machine.tool());
    default: return ControlError::WrongParameter;
  }
}

ControlConversation::Reply ControlConversation::next_error(bool first) {
  if (first) next_error_ = 0;
  const auto errors = state_.machine.errors();
  if (next_error_ >= errors.size()) return ControlError::NoNextError;
  const interpreter::RunMessage& error = errors[next_error_++];
  // A telegram ends at the end of its buffer, and so does a long text.
  constexpr std::size_t kLongestText = 200;
  return encode(Fault{.number = error.number,
                      .text = std::string(first_characters(error.text, kLongestText))});
}

ControlConversation::Reply ControlConversation::reply(const ReadMemory& request) {
  TRY(needs({"PLCDEBUG"}));
  const auto memory = TRY(read_memory(request.address, request.count));
  return encode(memory);
}

ControlConversation::Reply ControlConversation::reply(const ReadMachineParameter& request) {
  TRY(needs({"INSPECT"}));
  if (request.name == kRunParameter) return encode(MachineParameter{state_.machine.program().main});
  const auto found = state_.parameters.find(request.name);
  if (found == state_.parameters.end()) return ControlError::WrongParameter;
  return encode(MachineParameter{found->second});
}

ControlConversation::Reply ControlConversation::reply(const WriteMachineParameter& request) {
  TRY(needs_to_write("PLCDEBUG"));
  if (request.name == kRunParameter) return run_program(request.value);
  const auto found = state_.parameters.find(request.name);
  if (found == state_.parameters.end()) return ControlError::WrongParameter;
  found->second = request.value;
  return encode(control_link::Accepted{});
}

ControlConversation::Reply ControlConversation::run_program(const std::string& path) {
  if (path.empty()) {
    state_.machine.stop();
    return encode(control_link::Accepted{});
  }
  const auto program = TRY(file_path(path, directory_));
  TRY(state_.machine.start(program));
  return encode(control_link::Accepted{});
}

/// The keys of the operating modes switch the mode; every other key is accepted without effect.
ControlConversation::Reply ControlConversation::reply(const PressKey& request) {
  TRY(needs_to_write("MONITOR"));
  constexpr std::uint16_t kManual = 0x01C0;
  constexpr std::uint16_t kSingleBlock = 0x01C2;
  constexpr std::uint16_t kAutomatic = 0x01C3;
  constexpr std::uint16_t kHandwheel = 0x01C5;
  switch (request.key) {
    case kManual:
    case kHandwheel: state_.machine.set_mode(Mode::Manual); break;
    case kSingleBlock: state_.machine.set_mode(Mode::SingleBlock); break;
    case kAutomatic: state_.machine.set_mode(Mode::Automatic); break;
    default: break;
  }
  return encode(control_link::Accepted{});
}

ControlConversation::Reply ControlConversation::reply(const ReadDataPath& request) {
  if (!state_.model.is_itnc) return ControlError::UnknownTelegram;
  TRY(needs({"DATA"}));
  const auto value = TRY(read_data_path(request.path));
  return encode(value);
}

}  // namespace fitgauge::virtual_control
