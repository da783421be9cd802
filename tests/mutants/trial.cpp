#include "trial.hpp"

#include "nc/klartext/diagnostic.hpp"
#include "nc/program/parameter.hpp"
#include "nc/run/channel.hpp"

namespace fitgauge::mutants {
namespace {

using interpreter::ControlPath;
using interpreter::golden::Case;

/// Follows the lines of one file.
class Follower final : public interpreter::RunObserver {
 public:
  Follower(const Case& trial, std::string path, std::vector<std::string> watched = {})
      : trial_(trial), path_(std::move(path)), watched_(std::move(watched)) {}
  bool follows_every_block() const override { return true; }
  void begins(const interpreter::RunFiles& files, const interpreter::QParameters& parameters,
              const interpreter::CallStack& calls) override {
    files_ = &files;
    parameters_ = &parameters;
    calls_ = &calls;
  }
  void entered(const interpreter::Place& place) override {
    leave_block();
    place_ = place;
    line_ = ascii_iequals(place.path(), path_) ? place.line() : 0;
    if (line_ > 0) lines.insert(line_);
    line_of_command_.resize(trial_.commands(), before_);
    before_ = line_;
  }
  void printed(std::string_view line) override { screen.push_back({std::string(line), line_}); }
  void ends() override { leave_block(); }

  std::uint32_t line_of(std::size_t command) const {
    return command < line_of_command_.size() ? line_of_command_[command] : before_;
  }
  /// The block that has written what has not changed for longest.
  Finding settled_first() const {
    const auto first =
        std::ranges::min_element(last_, {}, [](const auto& each) { return each.second.block; });
    return first == last_.end() ? Finding{} : first->second.at;
  }

  std::set<std::uint32_t> lines;
  std::vector<Finding> screen;

 private:
  struct Last {
    std::string value{};
    std::size_t block = 0;
    Finding at{};
  };
  void leave_block() {
    ++blocks_;
    if (watched_.empty() || parameters_ == nullptr) return;
    for (const std::string& name : watched_) {
      if (const auto path = ControlPath::parse(name); path && name.find(':') != name.npos)
        keep(name, files_->revision(*path).value_or(""));
    }
    for (const auto& each : parameters_->all()) {
      const std::string name = interpreter::name(each.parameter);
      if (std::ranges::find(watched_, name) == watched_.end()) continue;
      const auto* number = std::get_if<double>(&each.value);
      keep(name,
           number != nullptr ? fmt::format("{}", *number) : std::get<std::string>(each.value));
    }
  }
  void keep(const std::string& name, const std::string& value) {
    if (value.empty()) return;
    Last& last = last_[name];
    if (last.value == value) return;
    last = {value, blocks_, {name, line_, {}}};
    if (line_ == 0) return;
    auto chain = calls_->behind_calls();
    chain.insert(chain.begin(), place_);
    for (const auto& origin : interpreter::origins_of_values(chain))
      if (origin.program.empty()) last.at.notes.push_back(origin.range.begin.line);
  }

  const Case& trial_;
  const std::string path_;
  const std::vector<std::string> watched_;
  const interpreter::RunFiles* files_ = nullptr;
  const interpreter::QParameters* parameters_ = nullptr;
  const interpreter::CallStack* calls_ = nullptr;
  interpreter::Place place_;
  std::uint32_t line_ = 0;
  std::uint32_t before_ = 0;
  std::size_t blocks_ = 0;
  std::vector<std::uint32_t> line_of_command_;
  std::map<std::string, Last> last_;
};

/// Whether a finding lies in that file.
bool is_in(std::string_view program, std::string_view file) {
  return ascii_iequals(program.substr(program.find_last_of("\\/") + 1), file);
}

Finding placed(std::string text, const std::string& program, std::uint32_t line,
               const std::vector<klartext::DiagnosticNote>& notes, std::string_view file) {
  Finding finding{std::move(text), is_in(program, file) ? line : 0, {}};
  for (const auto& note : notes)
    if (is_in(note.program.empty() ? program : note.program, file))
      finding.notes.push_back(note.range.begin.line);
  return finding;
}
Finding placed(std::string text, const klartext::Diagnostic& found, std::string_view file) {
  return placed(std::move(text), found.program, found.range.begin.line, found.notes, file);
}

/// The faces of a feature with how far a point lies off each, in mm.
class Faces {
 public:
  explicit Faces(const machine::Vec3& at) : at_(at) {}

  void operator()(const machine::Block& block) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bool is_beside = false;
      for (std::size_t across = 0; across < 3; ++across)
        is_beside = is_beside || (across != axis && (at_[across] < block.min[across] - kNear ||
                                                     at_[across] > block.max[across] + kNear));
      if (is_beside) continue;
      add(fmt::format("{}-", "XYZ"[axis]), at_[axis] - block.min[axis]);
      add(fmt::format("{}+", "XYZ"[axis]), at_[axis] - block.max[axis]);
    }
  }
  void operator()(const machine::Bore& bore) {
    cylinder(bore.centre, bore.top - bore.depth, bore.top, bore.diameter);
  }
  void operator()(const machine::Boss& boss) {
    cylinder(boss.centre, boss.top - boss.height, boss.top, boss.diameter);
  }
  void operator()(const machine::CalibrationRing& ring) {
    cylinder(ring.centre, ring.top - ring.height, ring.top, ring.diameter);
    add("top", at_.z - ring.top);
  }
  void operator()(const machine::Sphere& sphere) {
    add("sphere", machine::norm(at_ - sphere.centre) - sphere.diameter / 2);
  }
  void operator()(const machine::Surface&) { add("surface", kNear / 2); }
  void operator()(const auto&) {}

  const std::string& nearest() const { return nearest_; }
  double off() const { return off_; }
  static constexpr double kNear = 0.5;  // mm: more than any error of a machine of the tree

 private:
  void cylinder(const std::array<double, 2>& centre, double bottom, double top, double diameter) {
    const double from_axis = std::hypot(at_.x - centre[0], at_.y - centre[1]);
    if (at_.z > bottom - kNear && at_.z < top + kNear) add("wall", from_axis - diameter / 2);
    if (from_axis > diameter / 2) return;
    add("top", at_.z - top);
    add("bottom", at_.z - bottom);
  }
  void add(std::string face, double off) {
    if (std::abs(off) >= off_) return;
    off_ = std::abs(off);
    nearest_ = std::move(face);
  }

  machine::Vec3 at_;
  std::string nearest_;
  double off_ = kNear;
};

/// The face that is touched at a point of the machine; the point itself where none is near, so that
/// another one counts as another face.
std::string face_at(const machine::Setup& setup, const machine::Vec3& at) {
  std::string face = fmt::format("{:.3f} {:.3f} {:.3f}", at.x, at.y, at.z);
  double off = Faces::kNear;
  const auto look_at = [&](const std::string& name, const auto& feature) {
    Faces faces(at);
    faces(feature);
    if (faces.off() >= off) return;
    off = faces.off();
    face = name + " " + faces.nearest();
  };
  for (std::size_t i = 0; i < setup.features.size(); ++i)
    std::visit([&](const auto& each) { look_at(std::to_string(i), each); }, setup.features[i]);
  const machine::MachineSetup& machine = setup.machine;
  if (machine.calibration_ring) look_at("ring", *machine.calibration_ring);
  if (machine.calibration_stud) look_at("stud", *machine.calibration_stud);
  if (machine.calibration_sphere)
    look_at("calibration", machine::Sphere{machine.calibration_sphere->centre,
                                           2 * machine.calibration_sphere->radius});
  return face;
}

std::string text_of(const interpreter::ParameterValue& parameter) {
  const auto* number = std::get_if<double>(&parameter.value);
  return number != nullptr ? fmt::format("{:.6f}", std::round(*number * 1e6) / 1e6 + 0.0)
                           : std::get<std::string>(parameter.value);
}

void add(Outcome& outcome, const interpreter::RunResult& result, std::string_view file) {
  outcome.end.text = word(result.status);
  for (const auto& message : result.messages) {
    if (message.kind == interpreter::MessageKind::Note) continue;
    outcome.end = placed(outcome.end.text + fmt::format("; {} {}", message.number, message.text),
                         message.program, message.line, message.origins, file);
  }
  for (const auto& found : interpreter::findings_of(result)) {
    if (found.severity == klartext::Severity::Warning)
      outcome.alarms.push_back(placed(found.message, found, file));
  }
  for (const auto& measured : result.measurements) {
    const auto& record = measured.record;
    const auto at = [&](std::string text) {
      return placed(std::move(text), measured.program, measured.line, measured.origins, file);
    };
    const std::string cycle = fmt::format("cycle {}", record.cycle);
    const auto verdict = record.verdict ? gauging::word(*record.verdict) : "none";
    outcome.verdicts.push_back(at(fmt::format("{} {}", cycle, verdict)));
    for (const auto& size : record.sizes) {
      outcome.values.push_back(
          at(fmt::format("{} {} = {}", cycle, size.characteristic, size.measured.count())));
      std::string limits =
          fmt::format("{} {} {}", cycle, size.characteristic, size.nominal.count());
      if (size.limits)
        limits += fmt::format(" {} {}", size.limits->lower.count(), size.limits->upper.count());
      outcome.records.push_back(at(std::move(limits)));
    }
  }
  if (result.verdict) outcome.verdicts.push_back({std::string(gauging::word(*result.verdict))});
  for (const auto& preset : result.presets) {
    const auto& origin = preset.frame.origin;
    const auto& rotation = preset.frame.basic_rotation_deg;
    outcome.written.push_back(
        {fmt::format("preset {} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}", preset.number, origin.x,
                     origin.y, origin.z, rotation.x, rotation.y, rotation.z)});
  }
  outcome.written.push_back({fmt::format("preset {} active", result.active_preset)});
  for (const auto& parameter : result.parameters)
    outcome.parameters[interpreter::name(parameter.parameter)] = text_of(parameter);
  for (const auto& written : result.files) outcome.files[written.path.text()] = written.bytes;
}

/// The first finding of one that the other lacks at its place; of one that is gone, the block that
/// has made it in the original.
const Finding* first_difference(const std::vector<Finding>& original,
                                const std::vector<Finding>& mutant) {
  for (std::size_t i = 0; i < std::max(original.size(), mutant.size()); ++i) {
    if (i >= original.size()) return &mutant[i];
    if (i < mutant.size() && mutant[i].text == original[i].text) continue;
    const bool is_gone =
        mutant.size() < original.size() &&
        std::ranges::find(mutant, original[i].text, &Finding::text) == mutant.end();
    return is_gone || i >= mutant.size() ? &original[i] : &mutant[i];
  }
  return nullptr;
}

/// The names whose values differ.
std::vector<std::string> differing(const std::map<std::string, std::string>& original,
                                   const std::map<std::string, std::string>& mutant) {
  std::vector<std::string> names;
  for (const auto& [name, value] : original) {
    const auto here = mutant.find(name);
    if (here == mutant.end() || here->second != value) names.push_back(name);
  }
  return names;
}

}  // namespace

Outcome outcome_of(const Subject& subject, const std::string& text) {
  Case trial(subject.folder, subject.setup);
  trial.add(subject.file, text);
  trial.setup().options.limits.blocks = 20'000;
  Outcome outcome;
  for (const auto& found : trial.diagnostics(subject.main)) {
    if (found.severity == klartext::Severity::Note) continue;
    outcome.alarms.push_back(
        placed(fmt::format("{}: {} | {}", id(found.code), found.message, found.source), found,
               subject.file));
  }
  Follower follower(trial, Case::path(subject.file).text());
  const auto ran = trial.execute(subject.main, follower);
  if (!ran) return outcome;
  outcome.lines = std::move(follower.lines);
  add(outcome, ran->result, subject.file);
  for (const machine::Vec3& point : ran->touched)
    outcome.faces.push_back({face_at(trial.setup().machine, point)});
  std::ranges::sort(outcome.faces);
  for (std::size_t i = 0; i < ran->commands.size(); ++i) {
    const std::string& command = ran->commands[i];
    const std::uint32_t line = follower.line_of(i);
    const bool is_way = command.starts_with("PROBE ") || command.find(" FMAX") != command.npos;
    if (!is_way || command.starts_with("PROBE DATA")) outcome.commands.push_back({command, line});
    // Data of tools, the probe and the rotary axes, which the run leaves behind.
    if (command.starts_with("TOOL ") || command.starts_with("PROBE DATA") ||
        command.starts_with("TT ") || command.starts_with("KINEMATICS"))
      outcome.written.push_back({command, line});
    const bool is_row = command.starts_with("PRESET ROW ");
    for (Finding& each : outcome.written) {
      const bool is_it =
          is_row
              ? each.text.starts_with(fmt::format("preset {} ", std::atoi(command.c_str() + 11))) &&
                    !each.text.ends_with("active")
              : command.starts_with("PRESET ") && each.text.ends_with("active");
      if (is_it) each.line = line;
    }
  }
  outcome.written.insert(outcome.written.end(), follower.screen.begin(), follower.screen.end());
  outcome.tests_itself = text.find("D14 ") != text.npos || text.find("FN 14") != text.npos;
  return outcome;
}

std::string_view word(Found found) {
  constexpr std::array<std::string_view, kFound> kWords{
      "check", "run", "verdict", "value", "record", "faces", "commands", "equivalent"};
  return kWords[static_cast<std::size_t>(found)];
}

Judgement compare(const Outcome& original, const Outcome& mutant, const std::string& target) {
  for (const Finding& alarm : mutant.alarms) {
    const auto is_same = [&](const Finding& each) { return each.text == alarm.text; };
    if (std::ranges::count_if(mutant.alarms, is_same) >
        std::ranges::count_if(original.alarms, is_same))
      return {Found::Check, alarm};
  }
  if (mutant.end.text != original.end.text) {
    const bool is_gone = mutant.end.line == 0 && mutant.end.notes.empty();
    Finding end = is_gone ? original.end : mutant.end;
    end.text = mutant.end.text;
    return {Found::Run, std::move(end)};
  }
  if (const auto* found = first_difference(original.verdicts, mutant.verdicts))
    return {Found::Verdict, *found};
  if (const auto* found = first_difference(original.values, mutant.values))
    return {Found::Value, *found};
  if (const auto* found = first_difference(original.written, mutant.written))
    return {Found::Value, *found};
  Judgement judgement{Found::Value, {}, differing(original.parameters, mutant.parameters)};
  std::erase(judgement.differing, target);
  if (!judgement.differing.empty()) {
    const auto here = mutant.parameters.find(judgement.differing.front());
    judgement.at.text =
        judgement.differing.front() + " = " + (here == mutant.parameters.end() ? "" : here->second);
    return judgement;
  }
  if (const auto* found = first_difference(original.records, mutant.records))
    return {Found::Record, *found};
  if (original.files != mutant.files)
    return {Found::Record, {"files"}, differing(original.files, mutant.files)};
  if (const auto* found = first_difference(original.faces, mutant.faces))
    return {Found::Faces, *found};
  if (const auto* found = first_difference(original.commands, mutant.commands))
    return {Found::Commands, *found};
  return {Found::Equivalent};
}

Finding place_of_last(const Subject& subject, const std::string& text,
                      const std::vector<std::string>& names) {
  Case trial(subject.folder, subject.setup);
  trial.add(subject.file, text);
  trial.setup().options.limits.blocks = 20'000;
  Follower follower(trial, Case::path(subject.file).text(), names);
  trial.execute(subject.main, follower);
  return follower.settled_first();
}

}  // namespace fitgauge::mutants
