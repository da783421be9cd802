// Runs the parameter loop of the comparison and prints nanoseconds of CPU time a pass, one number a
// line. Usage: bench_loop [passes] [rounds]

#include <cstdio>
#include <ctime>

#include "nc/machine/machine_setup.hpp"
#include "nc/machine/simulated_machine.hpp"
#include "nc/program/program_cache.hpp"
#include "nc/run/interpreter.hpp"

using namespace fitgauge;
using namespace fitgauge::interpreter;

namespace {

std::string loop_program(long passes) {
  return "0 BEGIN PGM LOOP MM\n1 FN 0: Q1 = +0\n2 FN 0: Q2 = +0\n3 LBL 1\n4 Q2 = Q2 + Q1\n"
         "5 Q1 = Q1 + 1\n6 FN 12: IF +Q1 LT +" +
         std::to_string(passes) + " GOTO LBL 1\n7 END PGM LOOP MM\n";
}

double seconds_of_a_run(const std::shared_ptr<const LinkedProgram>& program, MemoryDisk& disk,
                        ProgramCache& programs) {
  machine::SimulatedMachine machine{machine::Setup{}};
  const SystemClock clock;
  RunObserver observer;
  RunOptions options;
  options.limits.blocks = 20'000'000;
  const std::clock_t begin = std::clock();
  const RunResult result = run(program, {machine, disk, programs, clock, observer}, options);
  const std::clock_t taken = std::clock() - begin;
  if (result.status != RunStatus::Completed) {
    std::fprintf(stderr, "%s\n", result.messages.back().text.c_str());
    std::exit(1);
  }
  return static_cast<double>(taken) / CLOCKS_PER_SEC;
}

}  // namespace

int main(int argc, char** argv) {
  const long passes = argc > 1 ? std::atol(argv[1]) : 3'000'000;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 1;
  MemoryDisk disk;
  ProgramCache programs;
  const auto path = ControlPath::parse("TNC:\\loop.h").value();
  disk.write(path, loop_program(passes));
  const auto file = programs.get(*disk.find(path));
  for (int round = 0; round < rounds; ++round) {
    std::printf("%.3f\n", seconds_of_a_run(file->program, disk, programs) * 1e9 /
                              static_cast<double>(passes));
  }
}
