#include "nc/run/run_log.hpp"

#include <doctest/doctest.h>

namespace fitgauge::interpreter {
namespace {

using machine::Axis;
using machine::AxisMount;
using machine::Kinematics;
using machine::Vec3;

Allowance unlimited;
const ControlPath kRecords = ControlPath::parse("TNC:\\TABLE\\data450.kd").value();
const std::string kHeader =
    "BEGIN DATA450 .KD MM\n"
    "NR  NAME  AXIS  ON     X     Y     Z     I     J     K\n";

NcResult<probing::KinematicsRecords> read(const std::string& rows) {
  MemoryDisk disk;
  disk.write(kRecords, kHeader + rows + "[END]\n");
  OutputBudget budget(1'000'000);
  return read_kinematics_records(RunFiles(disk, budget, 10), unlimited);
}

}  // namespace

TEST_CASE("records of kinematics come back as they were written") {
  const Kinematics table(
      {{Axis::A, AxisMount::Table, {1.0 / 3, -0.03, 1e-9}, {1, 2e-4, -1e-7}, -0.0123},
       {Axis::C, AxisMount::Table, {0, 0, -100}, {0, 0, 1}}},
      {0.1, 0, -2.0 / 7});
  const Kinematics head({{Axis::B, AxisMount::Head, {}, {0, 1, 0}}});
  const probing::KinematicsRecords records{{"7", table}, {"A NAME OF SIXTEE", head}, {"-", {}}};
  const MemoryDisk disk;
  OutputBudget budget(1'000'000);
  RunFiles files(disk, budget, 10);
  CHECK(read_kinematics_records(files, unlimited).value().empty());
  REQUIRE(write_kinematics_records(files, records).has_value());
  const auto again = read_kinematics_records(files, unlimited);
  REQUIRE(again.has_value());
  REQUIRE(again->size() == 3);
  for (const auto& record : records) {
    const auto& [name, model] = record;
    CAPTURE(record.first);
    const Kinematics& found = again->at(name);
    CHECK(found.offset() == model.offset());
    REQUIRE(found.axes().size() == model.axes().size());
    for (std::size_t k = 0; k < model.axes().size(); ++k) {
      CHECK(found.axes()[k].axis == model.axes()[k].axis);
      CHECK(found.axes()[k].mount == model.axes()[k].mount);
      CHECK(found.axes()[k].centre == model.axes()[k].centre);
      CHECK(found.axes()[k].zero_deg == model.axes()[k].zero_deg);
      CHECK(norm(found.axes()[k].direction - model.axes()[k].direction) < 1e-15);
    }
  }
  CHECK(files.take().size() == 1);
}

TEST_CASE("a file of records that is not one is error 1096 and says where") {
  CHECK(read("0   ONE   C     TABLE  0     0     0     0     0     1\n").value().size() == 1);
  for (const char* row : {"0   ONE   U     TABLE  0     0     0     0     0     1\n",
                          "0   ONE   X     TABLE  0     0     0     0     0     1\n",
                          "0   ONE   C     FLOOR  0     0     0     0     0     1\n",
                          "0   ONE   C     TABLE  0     0     zero  0     0     1\n",
                          "0   ONE   C     TABLE  0     0     0     0     0\n",
                          "0   ONE   C     TABLE  0     0     0     0     0     0\n",
                          ("0   ONE   C     TABLE  0     0     0     0     0     1\n"
                           "1   ONE   C     TABLE  0     0     0     0     0     1\n"),
                          "1   ONE   C     TABLE  0     0     0     0     0     1\n"}) {
    CAPTURE(row);
    const auto records = read(row);
    REQUIRE_FALSE(records.has_value());
    CHECK(records.error().number == 1096);
    CHECK(records.error().text.find("TNC:\\table\\DATA450.KD: row ") != std::string::npos);
  }
}

}  // namespace fitgauge::interpreter
