// Contacts of the touch probe on a bore, by cycle 421 from a program: four contacts a cycle, with
// positioning, circle fit and status. Prints contacts per second of CPU time, the median of the
// rounds. Usage: bench_probing [cycles] [rounds]

#include <cstdio>
#include <ctime>

#include "nc/machine/simulated_machine.hpp"
#include "nc/program/program_cache.hpp"
#include "nc/run/interpreter.hpp"

using namespace fitgauge;
using namespace fitgauge::interpreter;

namespace {

constexpr int kContactsOfACycle = 4;

std::string probing_program(long cycles) {
  return "BEGIN PGM BORE MM\nTOOL CALL 30 Z\nL Z+50 FMAX\nLBL 1\n"
         "TCH PROBE 421 MEASURE HOLE ~\n Q273=+50 ~\n Q274=+40 ~\n Q262=+25 ~\n Q325=+0 ~\n"
         " Q247=+90 ~\n Q261=-10 ~\n Q320=+0 ~\n Q260=+40 ~\n Q301=+0 ~\n Q275=+25.021 ~\n"
         " Q276=+25 ~\n Q279=+0 ~\n Q280=+0 ~\n Q281=+0 ~\n Q309=+0 ~\n Q330=+0\n"
         "CALL LBL 1 REP " +
         std::to_string(cycles - 1) + "\nEND PGM BORE MM\n";
}

machine::Setup setup_with_bore() {
  machine::Setup setup;
  setup.features = {machine::Block{{0, 0, -40}, {100, 80, 0}},
                    machine::Bore{{50, 40}, 0, 30, 25.013}};
  return setup;
}

double seconds_of_a_run(const std::shared_ptr<const LinkedProgram>& program, MemoryDisk& disk,
                        ProgramCache& programs) {
  machine::SimulatedMachine machine(setup_with_bore());
  const SystemClock clock;
  RunObserver observer;
  const RunOptions options;
  const std::clock_t begin = std::clock();
  const RunResult result = run(program, {machine, disk, programs, clock, observer}, options);
  const std::clock_t taken = std::clock() - begin;
  if (result.status != RunStatus::Completed || result.verdict != gauging::Verdict::Good) {
    std::fprintf(stderr, "the run did not end good\n");
    std::exit(1);
  }
  return static_cast<double>(taken) / CLOCKS_PER_SEC;
}

}  // namespace

int main(int argc, char** argv) {
  const long cycles = argc > 1 ? std::atol(argv[1]) : 5'000;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 7;
  MemoryDisk disk;
  ProgramCache programs;
  disk.write("TNC:\\bore.h", probing_program(cycles));
  const auto file = programs.get(*disk.find(ControlPath::parse("TNC:\\bore.h").value()));
  std::vector<double> rates;
  for (int round = 0; round < rounds; ++round) {
    rates.push_back(static_cast<double>(cycles) * kContactsOfACycle /
                    seconds_of_a_run(file->program, disk, programs));
  }
  std::sort(rates.begin(), rates.end());
  std::printf("%.0f contacts/s\n", rates[rates.size() / 2]);
}
