#include "nc/machine/simulated_machine.hpp"
#include "nc/probing/touch/fits.hpp"
#include "nc/program/program_cache.hpp"
#include "nc/run/interpreter.hpp"
#include "service/qualification/qualification.hpp"
#include "service/runs/control_files.hpp"

namespace fitgauge::app::qualification {
namespace {

constexpr std::int64_t kMm = 1'000'000;
constexpr std::size_t kMostWrong = 5;  ///< cells that are listed of a letter

using Values = std::vector<std::optional<std::int64_t>>;  ///< of each step, in nm
/// Upper and lower in nm; none: not defined.
using Deviations = std::optional<std::pair<std::int64_t, std::int64_t>>;

/// ISO 286-1 computed again: from iso286.txt and separate rules, without the room `tables`.
struct Standard {
  explicit Standard(const References& references) {
    std::vector<std::int64_t> main;  // ends of the main steps
    for (const Words& row : references.rows("iso286.txt")) {
      if (row[0] == "main" || row[0] == "step") {
        for (auto word = row.begin() + 1; word != row.end(); ++word) {
          (row[0] == "main" ? main : steps).push_back(std::stoll(*word) * kMm);
        }
        continue;
      }
      // From the first step that the row has a value of.
      const bool is_main = row[1] == "main";
      const std::int64_t from = is_main ? 0 : std::stoll(row[2]) * kMm;
      Values& to = values[row[0]];
      for (const std::int64_t end : steps) {
        const auto at = is_main ? std::lower_bound(main.begin(), main.end(), end) - main.begin()
                                : std::lower_bound(steps.begin(), steps.end(), end) -
                                      std::upper_bound(steps.begin(), steps.end(), from);
        const auto word = static_cast<std::size_t>(at + (is_main ? 2 : 3));
        const bool is_there = end > from && word < row.size() && row[word] != "-";
        to.push_back(is_there ? std::optional(std::llround(std::stod(row[word]) * 1000))
                              : std::nullopt);
      }
    }
  }

  std::optional<std::int64_t> value(const std::string& name, std::size_t step) const {
    const auto found = values.find(name);
    return found == values.end() ? std::nullopt : found->second[step];
  }

  /// @param n the grade; -1 for IT01
  Deviations deviations(const std::string& letter, bool is_hole, int n, std::size_t step,
                        std::int64_t size) const {
    const auto it = value(fmt::format("IT{}", n), step);
    std::string name = letter;
    for (char& c : name) c = static_cast<char>(c | 0x20);
    const bool is_absent = n >= 14 || name == "a" || name == "b" || (letter == "N" && n > 8);
    if (!it || (size <= kMm && is_absent)) return std::nullopt;
    if (name == "js") return std::pair(*it / 2, *it / 2 - *it);
    const auto from_zero = value(name == "j" ? letter + std::to_string(n) : name, step);
    if (!from_zero) return std::nullopt;
    const auto from_lower = [&](std::int64_t ei) { return std::pair(ei + *it, ei); };
    const auto from_upper = [&](std::int64_t es) { return std::pair(es, es - *it); };
    if (name < "i") return is_hole ? from_lower(*from_zero) : from_upper(-*from_zero);
    if (name == "j") return is_hole ? from_upper(*from_zero) : from_lower(-*from_zero);
    if (!is_hole) return from_lower(name == "k" && (n < 4 || n > 7) ? 0 : *from_zero);
    const bool is_middle = size > 3 * kMm && size <= 500 * kMm;
    if (name == "k" && n > 8 && size > 3 * kMm) return std::nullopt;
    if (name == "n" && n > 8 && is_middle) return from_upper(0);
    if (name == "m" && n == 6 && size > 250 * kMm && size <= 315 * kMm) return from_upper(-9000);
    if (!is_middle || n > (name == "k" || name == "m" || name == "n" ? 8 : 7))
      return from_upper(-*from_zero);
    if (n < 3) return std::nullopt;
    return from_upper(-*from_zero + *it - value(fmt::format("IT{}", n - 1), step).value());
  }

  std::vector<std::int64_t> steps;  ///< their ends
  std::map<std::string, Values> values;
};

namespace nc = interpreter;

machine::Vec3 point(const Words& row) {
  return {std::stod(row[0]), std::stod(row[1]), row.size() > 2 ? std::stod(row[2]) : 0};
}

}  // namespace

void check_iso286(const References& references, const iso286::ToleranceTables& tables,
                  std::vector<Check>& to) {
  const std::string source = "ISO 286-1:2010, tables 1 to 5, typed a second time";
  const Standard standard(references);
  for (std::uint16_t first = 0; first < iso286::kStandardClassCount; first += iso286::kGradeCount) {
    const auto of = iso286::standard_class({first});
    const std::string letter(text(of.letter, of.feature));
    std::int64_t cells = 0;
    std::int64_t right = 0;
    std::vector<Check> wrong;
    const auto check = [&](std::uint16_t grade, std::size_t step, std::int64_t size) {
      const iso286::ClassId id{static_cast<std::uint16_t>(first + grade)};
      auto expected =
          standard.deviations(letter, of.feature == iso286::Feature::Hole, grade - 1, step, size);
      if (expected && size + expected->second <= 0) expected.reset();
      Deviations got;
      if (const auto found = tables.limit_deviations(
              iso286::NominalSize::make(Length::nanometres(size)).value(), id)) {
        got = {found->upper.count(), found->lower.count()};
      }
      ++cells;
      right += got == expected;
      if (got == expected || wrong.size() == kMostWrong) return;
      const bool in_lower = got && expected && got->first == expected->first;
      const auto um = [in_lower](const Deviations& d) {
        return d ? static_cast<long double>(in_lower ? d->second : d->first) / 1000 : std::nanl("");
      };
      wrong.push_back(
          {fmt::format("iso286.{}.{:.6f}", tables.class_name(id), static_cast<double>(size) / kMm),
           source, in_lower ? "lower deviation / um" : "upper deviation / um",
           expected ? fmt::format("{}", um(expected)) : "null", "0", um(got)});
    };
    for (std::uint16_t grade = 0; grade < iso286::kGradeCount; ++grade) {
      check(grade, 0, kMm);
      for (std::size_t step = 0; step < standard.steps.size(); ++step) {
        check(grade, step, (step == 0 ? kMm : standard.steps[step - 1]) + 1);
        check(grade, step, standard.steps[step]);
      }
    }
    to.push_back(
        {"iso286." + letter, source,
         fmt::format("cells of {0}01 to {0}18 that agree, also where they are not defined", letter),
         std::to_string(cells), "0", static_cast<long double>(right)});
    to.insert(to.end(), wrong.begin(), wrong.end());
  }
}

void add_fits(const References& references, Figures& to) {
  for (int k = 1; k <= 6; ++k) {
    const std::string name = fmt::format("circle.{}", k);
    std::vector<machine::Vec3> points;
    for (const Words& row : references.set(name)) points.push_back(point(row));
    const auto circle = probing::fit_circle(points);
    if (circle) to.add(name, ".x .y .r", {circle->centre.x, circle->centre.y, circle->radius});
  }
  // Sets of points in space, each after a row with the approximate result.
  const auto each = [&](const char* kind, int count, const auto& fit) {
    for (int k = 1; k <= count; ++k) {
      const std::string name = fmt::format("{}.{}", kind, k);
      std::vector<machine::Vec3> points;
      std::vector<double> near;
      for (const Words& row : references.set(name)) {
        if (near.empty()) {
          for (const std::string& word : row) near.push_back(std::stod(word));
        } else {
          points.push_back(point(row));
        }
      }
      fit(name, points, near);
    }
  };
  using Points = std::vector<machine::Vec3>;
  using Near = std::vector<double>;
  each("sphere", 3, [&](const std::string& name, const Points& points, const Near& n) {
    const auto sphere = probing::fit_sphere(points, {{n.at(0), n.at(1), n.at(2)}, n.at(3)});
    if (!sphere) return;
    const auto& [x, y, z] = sphere->centre;
    to.add(name, ".x .y .z .r", {x, y, z, sphere->radius});
  });
  each("plane", 8, [&](const std::string& name, const Points& points, const Near& n) {
    const auto plane = probing::fit_plane(points, {n.at(0), n.at(1), n.at(2)});
    if (!plane) return;
    const auto& [a, b, c] = plane->normal;
    to.add(name, ".a .b .c .d", {a, b, c, dot(plane->normal, plane->point)});
  });
  each("cylinder", 8, [&](const std::string& name, const Points& points, const Near& n) {
    const auto cylinder = probing::fit_cylinder(
        points, {{n.at(0), n.at(1), n.at(2)}, {n.at(3), n.at(4), n.at(5)}, n.at(6)});
    if (!cylinder) return;
    const auto& [x, y, z] = cylinder->point;
    const auto& [a, b, c] = cylinder->direction;
    to.add(name, ".x .y .z .a .b .c .r", {x, y, z, a, b, c, cylinder->radius});
  });
}

void add_programs(const References& references, const iso286::ToleranceTables& tables,
                  Figures& to) {
  nc::MemoryDisk files;
  for (const auto& [name, text] : references.files) files.write("TNC:\\" + name, text);
  const nc::ProjectingDisk disk(files, project(tables));
  nc::ProgramCache programs;
  // Numeric parameters at the end, and the verdict.
  const auto run = [&](std::string_view program, const std::string& name,
                       const machine::Setup& setup,
                       std::vector<nc::ParameterValue> parameters = {}) {
    machine::SimulatedMachine machine(setup);
    nc::RunObserver observer;
    const SystemClock clock;
    nc::RunOptions options;
    options.parameters = std::move(parameters);
    const auto path = nc::ControlPath::parse(fmt::format("TNC:\\{0}\\{0}.h", program)).value();
    const nc::RunResult result = nc::run(programs.get(disk, path)->program,
                                         {machine, disk, programs, clock, observer}, options);
    for (const auto& [parameter, value] : result.parameters) {
      const auto* const number = std::get_if<double>(&value);
      if (number != nullptr) to.add(name, nc::name(parameter), {*number});
    }
    if (result.verdict) to.add(name, "verdict", {static_cast<long double>(*result.verdict)});
  };
  for (const Words& row : references.set("8255")) {
    machine::Setup setup{.machine = {}, .features = {machine::Block{{0, 0, -40}, {100, 80, 0}}}};
    std::vector<nc::ParameterValue> parameters;
    if (row[0] == "hole") {
      setup.features.emplace_back(machine::Bore{{50, 40}, 0, 30, std::stod(row[2])});
    } else {
      setup.features.emplace_back(machine::Boss{{50, 40}, 20, 20, std::stod(row[2])});
      parameters = {{nc::parse_parameter_name("QS1").value(), "g6"},
                    {nc::parse_parameter_name("Q31").value(), 10.0}};
    }
    run("8255", fmt::format("8255.{}.{}.", row[0], row[1]), setup, std::move(parameters));
  }
  for (const char* program : {"8210", "444"}) {
    machine::Surface surface;
    for (const Words& row : references.set(program)) surface.points.push_back(point(row));
    run(program, fmt::format("{}.", program), {.machine = {}, .features = {surface}});
  }
  machine::Setup mill{.machine = {}, .features = {}};
  mill.machine.tools.emplace_back().row.number = 5;
  run("8025", "8025.", mill);
  machine::Setup tilting{.machine = {}, .features = {}};
  for (const auto axis : {machine::Axis::A, machine::Axis::C}) {
    tilting.machine.axes.at(static_cast<std::size_t>(axis)) = machine::AxisSetup::of(axis);
  }
  tilting.machine.calibration_sphere = {{60, 25, 40}, 15};
  tilting.machine.presets[0].frame.origin = {60, 25, 40};
  run("451", "451.", tilting);
}

}  // namespace fitgauge::app::qualification
