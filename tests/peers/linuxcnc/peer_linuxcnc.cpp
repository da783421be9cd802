// Runs program 8255 on a LinuxCNC whose bridge listens on a socket, and prints what came of it.
// Usage: peer_linuxcnc SOCKET SECONDS; `run` beside it does all of it.

#include <cstdio>
#include <fstream>

#include "linuxcnc_axes.hpp"
#include "nc/machine/machine.hpp"
#include "nc/program/program_cache.hpp"
#include "nc/run/interpreter.hpp"
#include "tables/tabfile/iso286_projection.hpp"
#include "tables/tabfile/tab_table.hpp"

using namespace fitgauge;
using namespace fitgauge::interpreter;

namespace {

ControlPath path(const std::string& name) { return ControlPath::parse("TNC:\\" + name).value(); }

std::string read(const std::string& name) {
  std::ifstream in(std::string(FITGAUGE_SOURCE_DIR "/clients/nc/8255/") + name);
  return {std::istreambuf_iterator<char>(in), {}};
}

ProjectingDisk::Projection holes(const std::string& name) {
  const auto tables = iso286::ToleranceTables::make(iso286::compiled_in_tables(), {}).value();
  const auto table =
      std::make_shared<const tabfile::TabTable>(tabfile::project(tables, iso286::Feature::Hole));
  return {name, std::make_shared<const std::string>(tabfile::write_tab(*table)), "iso", table};
}

/// The control's tables for the mill of mill.ini: a probe of 120 mm with a ball of 4 mm.
machine::MachineSetup mill() {
  machine::MachineSetup setup;
  for (machine::ProbeSetup& probe : setup.probes) {
    constexpr double kOneMicrometreACycle = 60;  // mm/min with a servo cycle of 1 ms
    probe.row.feed = kOneMicrometreACycle;
  }
  return setup;
}

int run_on(const std::string& socket, double seconds) {
  MemoryDisk files;
  for (const char* name : {"8255.h", "82551.h", "82552.a"}) files.write(path(name), read(name));
  const ProjectingDisk disk(files, {holes("82553_hole.tab"), holes("82553_shaft.tab")});
  ProgramCache programs;
  RunOptions options;
  options.limits.time = std::chrono::duration<double>(seconds);
  Allowance allowance(options.limits.time, options.limits.memory_bytes, {});
  machine::Machine control(mill(), std::make_unique<peers::LinuxcncAxes>(socket), &allowance);
  const SystemClock clock;
  RunObserver observer;
  const auto program = programs.get(disk, path("8255.h"));
  const RunResult result =
      run(program->program, {control, disk, programs, clock, observer, &allowance}, options);
  std::printf("%s\n", std::string(word(result.status)).c_str());
  for (const std::string& line : result.screen) std::printf("screen %s\n", line.c_str());
  for (const RunMessage& message : result.messages) std::printf("%s\n", message.text.c_str());
  for (const auto& [parameter, value] : result.parameters) {
    const auto* number = std::get_if<double>(&value);
    const std::string name = interpreter::name(parameter);
    if (number != nullptr && name.starts_with("Q15"))
      std::printf("%s %.6f\n", name.c_str(), *number);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "peer_linuxcnc SOCKET SECONDS\n");
    return 2;
  }
  return run_on(argv[1], std::atof(argv[2]));
} catch (const std::exception& failure) {
  std::fprintf(stderr, "peer_linuxcnc: %s\n", failure.what());
  return 1;
}
