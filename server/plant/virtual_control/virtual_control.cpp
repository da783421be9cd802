#include "plant/virtual_control/control_conversation.hpp"

namespace fitgauge::virtual_control {
namespace {

constexpr ControlModel kModels[] = {
    {.name = "TNC640", .nc_software = "340595 08 SP1"},
    {.name = "TNC7", .nc_software = "817625 17 SP1"},
    {.name = "TNC320", .nc_software = "771855 05 SP1"},
    {.name = "iTNC530", .nc_software = "340494 08 SP1", .is_itnc = true},
    {.name = "iTNC530 Programming station",
     .nc_software = "340494 08 SP1",
     .is_itnc = true,
     .asks_plc_password = false},
};

std::string tool_table(const machine::Setup& setup) {
  std::string text =
      fmt::format("BEGIN TOOL .T MM\n{:<8}{:<33}{:<12}{:<12}TP_NO\n", "T", "NAME", "L", "R");
  for (const machine::ToolSetup& tool : setup.machine.tools) {
    text += fmt::format("{:<8}{:<33}{:<+12.4f}{:<+12.4f}{}\n", tool.row.number, tool.row.name,
                        tool.row.l, tool.row.r, tool.row.probe);
  }
  return text + "[END]\n";
}

/// Stores a file unless one of that name exists.
Result<void> bring(app::FileService& files, std::string_view path, const std::string& bytes) {
  auto parsed = TRY(interpreter::ControlPath::parse(path));
  const auto done = wait_for_result<bool>([&](auto written) {
    files.write(
        std::move(parsed), bytes, std::nullopt,
        [](std::optional<std::string_view> stored) { return !stored; }, written);
  });
  if (!done && done.error().code != ErrorCode::PreconditionFailed) return done.error();
  return {};
}

/// Stores the files that every control of this model has, and the example programs.
Result<void> bring_files(app::FileService& files, const ControlModel& model,
                         const machine::Setup& setup) {
  // The iTNC 530 has the control's own files in the root, in capitals.
  std::vector<std::pair<std::string, std::string>> brought{
      {model.is_itnc ? "TNC:\\$MDI.H" : "TNC:\\nc_prog\\$mdi.h",
       "BEGIN PGM $MDI MM\nEND PGM $MDI MM\n"},
      {model.is_itnc ? "TNC:\\TOOL.T" : "TNC:\\table\\tool.t", tool_table(setup)}};
  for (const ExampleProgram& example : example_programs()) {
    brought.emplace_back(fmt::format("TNC:\\nc_prog\\{}", example.path), example.text);
  }
  for (const auto& [path, bytes] : brought) TRY(bring(files, path, bytes));
  return {};
}

/// Stores the files that a run has written at its end, as a control does.
void keep_files(app::FileService& files, const std::shared_ptr<app::ActiveRun>& run) {
  run->on_end([&files, run](const Result<app::FinishedRun>&) {
    const auto written = run->look(app::Look::StateAndFiles, {}).files;
    if (written == nullptr) return;
    for (const interpreter::WrittenFile& file : *written) {
      files.write(file.path, file.bytes, std::nullopt, {}, [written](const Result<bool>&) {});
    }
  });
}

}  // namespace

std::span<const ControlModel> control_models() { return kModels; }

Result<std::unique_ptr<VirtualControl>> start_virtual_control(VirtualControlOptions options,
                                                              app::FileService& files,
                                                              app::RunService& runs) {
  const auto* const model = std::ranges::find(kModels, options.model, &ControlModel::name);
  if (model == std::end(kModels)) {
    return Error{ErrorCode::ConfigInvalid, "unknown control model '" + options.model + "'"};
  }
  TRY(bring_files(files, *model, options.setup));
  auto start = [&files, begin = std::move(options.start)](const interpreter::ControlPath& path) {
    auto run = begin(path);
    if (run) keep_files(files, *run);
    return run;
  };
  const auto state = std::make_shared<ControlState>(
      ControlState{.model = *model,
                   .is_writable = options.is_writable,
                   .disk = VirtualDisk(files, runs),
                   .machine = MachineView(runs, std::move(options.setup), std::move(start))});
  // The machine parameter of the dialog language.
  state->parameters.emplace(model->is_itnc ? "7230.0" : "CfgDisplayLanguage.ncLanguage",
                            model->is_itnc ? "0" : "ENGLISH");
  return LinkServer::start(
      std::move(options.link),
      {.converse = [state] { return std::make_unique<ControlConversation>(*state); },
       .sent_away = std::move(options.sent_away)});
}

}  // namespace fitgauge::virtual_control
