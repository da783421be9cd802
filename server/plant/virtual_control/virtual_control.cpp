#include "plant/virtual_control/virtual_control.hpp"

#include "base/thread.hpp"

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

/// Maximum for all transfers of all clients.
constexpr std::size_t kTransferBytes = std::size_t{24} << 20;

std::string mdi_program() { return "BEGIN PGM $MDI MM\nEND PGM $MDI MM\n"; }

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

/// The files of every control of that model, and the example programs.
Result<void> bring_files(app::FileService& files, const ControlModel& model,
                         const machine::Setup& setup) {
  std::vector<std::pair<std::string, std::string>> brought{
      {std::string(model.mdi_program()), mdi_program()},
      {std::string(model.tool_table()), tool_table(setup)}};
  for (const ExampleProgram& example : example_programs()) {
    brought.emplace_back(fmt::format("TNC:\\nc_prog\\{}", example.path), example.text);
  }
  for (const auto& [path, bytes] : brought) TRY(bring(files, path, bytes));
  return {};
}

/// Files of a run are on the disk at its end, as on a control.
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

const ControlModel* find_model(std::string_view name) {
  for (const ControlModel& model : kModels) {
    if (model.name == name) return &model;
  }
  return nullptr;
}

struct VirtualControl::Parts {
  ControlState state;
  std::unique_ptr<control_link::LinkServer> server{};  // ends first
};

Result<std::unique_ptr<VirtualControl>> VirtualControl::start(VirtualControlOptions options,
                                                              app::FileService& files,
                                                              app::RunService& runs) {
  const ControlModel* const model = find_model(options.model);
  if (model == nullptr) {
    return Error{ErrorCode::ConfigInvalid, "unknown control model '" + options.model + "'"};
  }
  TRY(bring_files(files, *model, options.setup));
  auto start = [&files, begin = std::move(options.start)](const interpreter::ControlPath& path) {
    auto run = begin(path);
    if (run) keep_files(files, *run);
    return run;
  };
  auto parts = std::unique_ptr<Parts>(
      new Parts{.state = {.model = *model,
                          .is_writable = options.is_writable,
                          .disk = VirtualDisk(files, runs),
                          .machine = MachineView(runs, std::move(options.setup), std::move(start)),
                          .transfers = ByteBudget(kTransferBytes)}});
  parts->state.parameters.emplace(model->language_parameter(), model->language());
  auto server = control_link::LinkServer::start(
      std::move(options.link),
      {.converse = [state =
                        &parts->state] { return std::make_unique<ControlConversation>(*state); },
       .sent_away = std::move(options.sent_away)});
  if (!server) return server.error();
  parts->server = *std::move(server);
  return std::unique_ptr<VirtualControl>(new VirtualControl(std::move(parts)));
}

VirtualControl::VirtualControl(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
VirtualControl::~VirtualControl() = default;
std::uint16_t VirtualControl::port() const { return parts_->server->port(); }

}  // namespace fitgauge::virtual_control
