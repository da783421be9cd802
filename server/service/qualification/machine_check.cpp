#include <fmt/format.h>

#include "nc/machine/simulated_machine.hpp"
#include "nc/probing/touch/fits.hpp"
#include "nc/run/interpreter.hpp"
#include "service/qualification/qualification.hpp"
#include "tables/tabfile/iso286_projection.hpp"

namespace fitgauge::app::qualification {
namespace {

namespace nc = interpreter;

machine::Vec3 point(const Words& row) {
  return {std::stod(row[0]), std::stod(row[1]), row.size() > 2 ? std::stod(row[2]) : 0};
}

nc::ProjectingDisk::Projection projection(const iso286::ToleranceTables& tables,
                                          iso286::Feature feature) {
  const auto table = std::make_shared<const tabfile::TabTable>(tabfile::project(tables, feature));
  return {fmt::format("82553_{}.tab", word(feature)),
          std::make_shared<const std::string>(tabfile::write_tab(*table)), "", table};
}

}  // namespace

void add_fits(const References& references, Figures& to) {
  for (int k = 1; k <= 6; ++k) {
    const std::string name = fmt::format("circle.{}", k);
    std::vector<probing::Point2> points;
    for (const Words& row : references.set(name)) points.push_back({point(row).x, point(row).y});
    const auto circle = probing::fit_circle(points);
    if (circle) to.add(name, ".x .y .r", {circle->centre.x, circle->centre.y, circle->radius});
  }
  for (int k = 1; k <= 3; ++k) {
    const std::string name = fmt::format("sphere.{}", k);
    const auto rows = references.set(name);
    std::vector<machine::Vec3> points;
    for (std::size_t i = 1; i < rows.size(); ++i) points.push_back(point(rows[i]));
    const auto sphere = probing::fit_sphere(points, {point(rows.at(0)), std::stod(rows[0].at(3))});
    if (!sphere) continue;
    const auto& [x, y, z] = sphere->centre;
    to.add(name, ".x .y .z .r", {x, y, z, sphere->radius});
  }
}

void add_programs(const References& references, const iso286::ToleranceTables& tables,
                  Figures& to) {
  nc::MemoryDisk files;
  for (const auto& [name, text] : references.files) files.write("TNC:\\" + name, text);
  const nc::ProjectingDisk disk(files, {projection(tables, iso286::Feature::Hole),
                                        projection(tables, iso286::Feature::Shaft)});
  nc::ProgramCache programs;
  // What the parameters of numbers hold at the end, and the verdict.
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
}

}  // namespace fitgauge::app::qualification
