#include "base/clock.hpp"
#include "cli/commands.hpp"
#include "cli/local_files.hpp"
#include "plant/lsv2/link/link_client.hpp"

namespace fitgauge::cli {
namespace {

// `fitgauge control …`: a HEIDENHAIN control over LSV-2. Each command names the control, HOST or
// HOST:PORT, and logs in with the least rights it needs. No other command sends to a control.

using control_link::ControlError;
using control_link::LinkClient;
using control_link::LinkFailure;
using control_link::ProgramState;
using control_link::ReadRunInformation;
using control_link::Transfer;

constexpr std::size_t kMostEntries = 100'000;
constexpr std::size_t kMostBytes = std::size_t{256} << 20;
constexpr std::size_t kMostErrors = 100;
constexpr std::uint32_t kNothingTouched = 1014;  ///< a probing move without contact
constexpr std::chrono::milliseconds kStateInterval{200};

Failure failure_of(const LinkFailure& failure) {
  switch (failure.kind) {
    case LinkFailure::Kind::Refused: return {ExitCode::Refused, failure.message};
    case LinkFailure::Kind::Unfit: return {ExitCode::LocalFile, failure.message};
    default: return {ExitCode::NoAnswer, failure.message};
  }
}

/// Returns the failure with the path of a file before its text.
Failure failure_of(const std::string& path, const LinkFailure& failure) {
  Failure named = failure_of(failure);
  named.message = path + ": " + named.message;
  return named;
}

Outcome<void> log_in(LinkClient& control, std::initializer_list<std::string_view> logins) {
  for (const std::string_view login : logins) {
    if (const auto done = control.login(login); !done) return failure_of(done.error());
  }
  return {};
}

/// A connection with INSPECT, the largest buffer, and these logins.
Outcome<LinkClient> connect(const std::string& address,
                            std::initializer_list<std::string_view> logins) {
  const auto parsed = control_link::parse_control_address(address);
  if (!parsed) {
    return Failure::of(ExitCode::Usage,
                       "address of the control must be HOST or HOST:PORT; got '{}'", address);
  }
  auto control = LinkClient::connect({.address = *parsed});
  if (!control) return failure_of(control.error());
  TRY(log_in(*control, {"INSPECT"}));
  if (const auto agreed = control->agree_buffer(); !agreed) return failure_of(agreed.error());
  TRY(log_in(*control, logins));
  return *std::move(control);
}

/// Files that a control stores as lines: programs and tables.
Transfer transfer_of(std::string_view path) {
  constexpr std::array<std::string_view, 8> kLines{".h", ".i", ".t",   ".tch",
                                                   ".d", ".p", ".tab", ".pnt"};
  const bool is_lines = std::ranges::any_of(kLines, [path](std::string_view ending) {
    return path.size() > ending.size() &&
           ascii_iequals(path.substr(path.size() - ending.size()), ending);
  });
  return is_lines ? Transfer::Lines : Transfer::Binary;
}

std::string_view name_of(std::uint16_t mode) {
  constexpr std::array<std::string_view, 5> kNames{"manual", "mdi", "reference run", "single block",
                                                   "automatic"};
  return mode < kNames.size() ? kNames.at(mode) : "unknown";
}

std::string_view name_of(ProgramState state) {
  constexpr std::array<std::string_view, 8> kNames{"started",         "stopped",     "finished",
                                                   "cancelled",       "interrupted", "failed",
                                                   "failure cleared", "idle"};
  const auto i = static_cast<std::size_t>(state);
  return i < kNames.size() ? kNames.at(i) : "unknown";
}

/// All data of `control state`.
struct MachineState {
  control_link::ControlIdentity identity{};
  std::uint16_t mode = 0;
  ProgramState state = ProgramState::Idle;
  control_link::ProgramStack program{};
  control_link::AxisTexts axes{};
  control_link::Overrides overrides{};
  std::vector<control_link::Fault> errors{};
};

/// Requests one item; an item that the control does not return stays unchanged.
template <class Answer>
Outcome<void> ask_for(LinkClient& control, std::uint16_t which, Answer& into) {
  auto answer = control.ask<Answer>(ReadRunInformation{which});
  if (answer) {
    into = *std::move(answer);
  } else if (answer.error().kind != LinkFailure::Kind::Refused) {
    return failure_of(answer.error());
  }
  return {};
}

Outcome<std::vector<control_link::Fault>> read_errors(LinkClient& control) {
  std::vector<control_link::Fault> errors;
  for (auto which = ReadRunInformation::kFirstError; errors.size() < kMostErrors;
       which = ReadRunInformation::kNextError) {
    auto error = control.ask<control_link::Fault>(ReadRunInformation{which});
    if (!error) {
      // Without a further error, or if the control does not return errors.
      if (error.error().kind == LinkFailure::Kind::Refused) break;
      return failure_of(error.error());
    }
    errors.push_back(*std::move(error));
  }
  return errors;
}

Outcome<MachineState> read_state(LinkClient& control) {
  MachineState machine;
  auto identity = control.identity();
  if (!identity) return failure_of(identity.error());
  machine.identity = *std::move(identity);
  control_link::State mode;
  control_link::State state{static_cast<std::uint16_t>(ProgramState::Idle)};
  control_link::Axes axes;
  TRY(ask_for(control, ReadRunInformation::kMode, mode));
  TRY(ask_for(control, ReadRunInformation::kState, state));
  TRY(ask_for(control, ReadRunInformation::kProgram, machine.program));
  TRY(ask_for(control, ReadRunInformation::kAxes, axes));
  TRY(ask_for(control, ReadRunInformation::kOverride, machine.overrides));
  machine.mode = mode.value;
  machine.state = static_cast<ProgramState>(state.value);
  machine.axes = std::move(axes.axes);
  machine.errors = TRY(read_errors(control));
  return machine;
}

std::string json_array(const std::vector<std::string>& items) {
  return fmt::format("[{}]", fmt::join(items, ","));
}

std::string state_json(const MachineState& machine) {
  JsonObject axes;
  for (std::size_t i = 0; i < machine.axes.names.size(); ++i)
    axes.add(machine.axes.names[i], machine.axes.positions[i]);
  std::vector<std::string> errors;
  for (const auto& error : machine.errors)
    errors.push_back(JsonObject().add("number", error.number).add("text", error.text).text());
  const auto percent = [](std::uint32_t hundredths) {
    return fmt::format("{}", hundredths / 100.0);
  };
  return JsonObject()
      .add("control", machine.identity.control)
      .add("nc_software", machine.identity.nc_software)
      .add("plc", machine.identity.plc)
      .add("mode", name_of(machine.mode))
      .add("state", name_of(machine.state))
      .add("program", machine.program.main)
      .add("current", machine.program.current)
      .add("line", machine.program.line)
      .add_raw("axes", axes.text())
      .add_raw("feed_percent", percent(machine.overrides.feed))
      .add_raw("spindle_percent", percent(machine.overrides.spindle))
      .add_raw("rapid_percent", percent(machine.overrides.rapid))
      .add_raw("errors", json_array(errors))
      .text();
}

void print_state(const Context& context, const MachineState& machine) {
  context.print("control    {}, NC software {}, PLC {}\n", machine.identity.control,
                machine.identity.nc_software, machine.identity.plc);
  context.print("mode       {}\n", name_of(machine.mode));
  context.print("state      {}\n", name_of(machine.state));
  if (!machine.program.main.empty()) {
    context.print("program    {}\n", machine.program.main);
    context.print("block      {} line {}\n", machine.program.current, machine.program.line);
  }
  context.print("axes      ");
  for (std::size_t i = 0; i < machine.axes.names.size(); ++i)
    context.print(" {} {}", machine.axes.names[i], machine.axes.positions[i]);
  context.print("\noverrides  feed {} %, spindle {} %, rapid {} %\n",
                machine.overrides.feed / 100.0, machine.overrides.spindle / 100.0,
                machine.overrides.rapid / 100.0);
  for (const auto& error : machine.errors)
    context.print("error      {}: {}\n", error.number, error.text);
}

/// Whether the control has a file of that name.
Outcome<bool> is_there(LinkClient& control, const std::string& path) {
  const auto found = control.file_information(path);
  if (found) return true;
  if (found.error().is_refusal(ControlError::NoFile)) return false;
  return failure_of(path, found.error());
}

/// Returns the destination as the control writes it. A trailing slash makes it a folder.
std::string destination_of(const std::string& destination, const std::string& file) {
  const bool is_folder = destination.ends_with('\\') || destination.ends_with('/');
  return control_path(is_folder ? destination + std::string(base_name(file)) : destination);
}

Outcome<ProgramState> wait_for_end(LinkClient& control) {
  for (;;) {
    const auto state =
        control.ask<control_link::State>(ReadRunInformation{ReadRunInformation::kState});
    if (!state) return failure_of(state.error());
    const auto shown = static_cast<ProgramState>(state->value);
    if (shown != ProgramState::Started) return shown;
    std::this_thread::sleep_for(kStateInterval);
  }
}

/// `control ls ADDRESS [DIRECTORY]`
Outcome<ExitCode> run_control_ls(const Context& context, const Words& words) {
  const std::string& directory = words[1];
  auto control = TRY(connect(words[0], {"FILE"}));
  const std::string path = directory.empty() ? "TNC:\\" : control_path(directory);
  const auto entries = control.list(path, kMostEntries);
  if (!entries) return failure_of(path, entries.error());
  std::vector<std::string> rows;
  for (const control_link::DirectoryEntry& entry : *entries) {
    const bool is_folder = (entry.flags & (control_link::FileInformation::kDirectory |
                                           control_link::FileInformation::kDirectoryOfItnc)) != 0;
    const Timestamp modified{std::int64_t{entry.unix_time} * 1'000'000'000};
    if (context.json) {
      rows.push_back(JsonObject()
                         .add("name", entry.name)
                         .add_raw("folder", is_folder ? "true" : "false")
                         .add("size", entry.bytes)
                         .add("modified_at", format_rfc3339(modified))
                         .text());
    } else {
      context.print("{:>9}  {}  {}{}\n", entry.bytes, format_rfc3339(modified), entry.name,
                    is_folder ? "\\" : "");
    }
  }
  if (context.json)
    context.print_document(JsonObject().add_raw("entries", json_array(rows)).text());
  return ExitCode::Good;
}

struct ControlGetOptions {
  std::string address;
  std::string path;
  std::string file{};  ///< its name here when empty; `-` is standard output
  bool force = false;  ///< replace a file that is there
};

/// `control get ADDRESS PATH [FILE]`: bytes as they are on the control.
Outcome<ExitCode> run_control_get(const Context&, const ControlGetOptions& options) {
  const std::string path = control_path(options.path);
  const std::string file = options.file.empty() ? std::string(base_name(path)) : options.file;
  auto control = TRY(connect(options.address, {"FILE"}));
  const auto bytes = control.download(path, Transfer::Binary, kMostBytes);
  if (!bytes) return failure_of(path, bytes.error());
  TRY(may_replace(file, options.force));
  const auto written = write_file(file, *bytes);
  return written ? Outcome<ExitCode>(ExitCode::Good) : written.error();
}

struct ControlPutOptions {
  std::vector<std::string> words;  ///< ADDRESS FILE… DESTINATION
  bool force = false;              ///< replace a file that is on the control
};

/// `control put`: programs and tables as lines, other files as bytes.
/// @errors Refused if the control has a file of that name and `force` is not set.
Outcome<ExitCode> run_control_put(const Context& context, const ControlPutOptions& options) {
  const std::string& destination = options.words.back();
  const std::vector<std::string> files(options.words.begin() + 1, options.words.end() - 1);
  if (files.size() > 1 && !destination.ends_with('\\') && !destination.ends_with('/'))
    return Failure::of(ExitCode::Usage, "several files need a folder: write {}/", destination);
  auto control = TRY(connect(options.words.front(), {"FILE"}));
  for (const std::string& file : files) {
    const auto bytes = TRY(read_file(file));
    const std::string path = destination_of(destination, file);
    if (!options.force) {
      const auto there = TRY(is_there(control, path));
      if (there)
        return Failure{ExitCode::Refused, path + ": exists on the control; --force replaces it"};
    }
    const auto sent = control.upload(path, bytes, transfer_of(path));
    if (!sent) return failure_of(path, sent.error());
    if (!context.json) context.print("{}  {} bytes\n", path, bytes.size());
  }
  return ExitCode::Good;
}

/// `control run ADDRESS PROGRAM`: starts a program of a virtual control and waits for its end.
/// @errors Refused at a real control: LSV-2 has no NC start. ProgramFailed.
Outcome<ExitCode> run_control_run(const Context& context, const Words& words) {
  const std::string& address = words[0];
  auto control = TRY(connect(address, {}));
  const auto identity = control.identity();
  if (!identity) return failure_of(identity.error());
  if (identity->plc != control_link::kVirtualPlc) {
    return Failure::of(
        ExitCode::Refused,
        "{} at {} is a real control: start the program at the machine, LSV-2 has no NC start",
        identity->control, address);
  }
  TRY(log_in(control, {"FILE", "DNC", "PLCDEBUG"}));
  const std::string path = control_path(words[1]);
  const auto started = control.tell(control_link::WriteMachineParameter{
      .name = std::string(control_link::kRunParameter), .value = path});
  if (!started) return failure_of(path, started.error());
  const auto state = TRY(wait_for_end(control));
  const auto errors = TRY(read_errors(control));
  for (const auto& error : errors) context.note("{}: {}", error.number, error.text);
  if (state != ProgramState::Finished) {
    const bool is_missed = std::ranges::any_of(
        errors, [](const auto& error) { return error.number == kNothingTouched; });
    return Failure::of(ExitCode::ProgramFailed, "{} ended with status {}{}", path, name_of(state),
                       is_missed
                           ? ": if the machine has no workpiece, start fitgauged with a setup "
                             "(--control-setup)"
                           : "");
  }
  if (!context.json) context.print("{} {}\n", path, name_of(state));
  return ExitCode::Good;
}

/// `control state ADDRESS`
Outcome<ExitCode> run_control_state(const Context& context, const Words& words) {
  auto control = TRY(connect(words[0], {"DNC"}));
  const auto machine = TRY(read_state(control));
  if (context.json) {
    context.print_document(state_json(machine));
  } else {
    print_state(context, machine);
  }
  return ExitCode::Good;
}

}  // namespace

void add_control(CLI::App& app, Action& chosen) {
  CLI::App* control = app.add_subcommand("control", "A HEIDENHAIN control over LSV-2");
  control->require_subcommand(1);
  const Word address{"address", "The control: HOST or HOST:PORT"};
  add_words(*control, "ls", "List a folder of a control", chosen,
            {address, {"directory", "Folder on the control (default: TNC:)"}}, 1, run_control_ls);
  const auto [get, got] = add_command(*control, "get", "Fetch a file: control get tnc TNC:/log.txt",
                                      chosen, run_control_get);
  get->add_option("address", got->address, address.help)->required();
  get->add_option("path", got->path, "Path on the control")->required();
  get->add_option("file", got->file, "Local file (default: the same name); - is standard output");
  get->add_flag("--force", got->force, "Replace an existing file");
  const auto [send, put] = add_command(
      *control, "put", "Send files: control put tnc part.h TNC:/nc_prog/", chosen, run_control_put);
  send->add_option("paths", put->words,
                   "Address of the control, local files, then the path or folder/ on the control")
      ->required()
      ->expected(3, CLI::detail::expected_max_vector_size);
  send->add_flag("--force", put->force, "Replace an existing file on the control");
  add_words(*control, "run", "Run a program of a virtual control", chosen,
            {address, {"program", "Path of the program on the control"}}, 2, run_control_run);
  add_words(*control, "state", "Print mode, program, axes and errors of a control", chosen,
            {address}, 1, run_control_state);
}

}  // namespace fitgauge::cli
