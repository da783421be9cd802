#include "service/runs/control_files.hpp"

#include <doctest/doctest.h>

namespace fitgauge::app {
namespace {

constexpr const char* kToolTable =
    "BEGIN TOOL .T MM\r\n"
    "; edited on the machine\r\n"
    "T       NAME      L         R         DR        TL  LBREAK    CUT  DIRECT TYP  TP_NO\r\n"
    "0\r\n"
    "5       MILL_D8   +92.5     +4                  L             4    +      MILL\r\n"
    "5.1     MILL_D8S  +93       +4\r\n"
    "30      PROBE     +150.25   +3        -0.01         0.2                   21   2\r\n"
    "[END]\r\n";

constexpr const char* kProbeTable =
    "BEGIN TCHPROBE .TP MM\n"
    "NO      TYPE   CAL_OF1   CAL_OF2   CAL_ANG   F         FMAX      DIST      SET_UP    "
    "F_PREPOS     TRACK  REACTION\n"
    "2       TS460  +0.012    -0.004    0         300       2000      15        3         "
    "FMAX_MACHINE ON     EMERGSTOP\n"
    "[END]\n";

constexpr const char* kPresetTable =
    "BEGIN PRESET .PR MM\n"
    "NO      DOC         X         Y         Z         SPC       A_OFFS    LOCKED\n"
    "0                   +0        +0        +0\n"
    "5       vice        -100.5    +20       +7.25     1.5       2         1\n"
    "[END]\n";

class Disk {
 public:
  Disk& with(std::string_view path, std::string bytes) {
    disk_.write(path, std::move(bytes));
    return *this;
  }
  ControlTables read() const {
    Allowance unlimited;
    return read_control_tables(disk_, unlimited).value();
  }
  std::string error() const {
    Allowance unlimited;
    const auto tables = read_control_tables(disk_, unlimited);
    if (tables) return "read";
    CHECK(tables.error().code == ErrorCode::TableFileMalformed);
    return tables.error().message;
  }

 private:
  interpreter::MemoryDisk disk_;
};

/// A disk with the three tables.
class FullDisk : public Disk {
 public:
  FullDisk() {
    with("TNC:\\table\\tool.t", kToolTable);
    with("TNC:\\table\\tchprobe.tp", kProbeTable);
    with("TNC:\\table\\preset.pr", kPresetTable);
  }
};

TEST_CASE("a disk without tables adds nothing") {
  const ControlTables tables = Disk().read();
  machine::MachineSetup setup;
  add_rows(tables, {}, setup);
  CHECK(setup.tools.size() == 1);
  CHECK(setup.probes.size() == 1);
  CHECK(setup.presets.size() == 1);
}

TEST_CASE("lathe tools come from toolturn.trn, with TL and LTOL of tool.t") {
  FullDisk disk;
  disk.with("TNC:\\table\\toolturn.trn",
            "BEGIN TOOLTURN .TRN MM\n"
            "T       NAME      ZL        XL        YL        DZL       DXL       RS    TO  ORI\n"
            "5       ROUGH     +110      -35.5     +0        -0.01     +0.02     0.8   7   90\n"
            "6       BORING    +150      +12                                     0.2   7   0\n"
            "[END]\n");
  const auto tools = disk.read().tools;
  REQUIRE(tools.size() == 3);
  const machine::Tool& rough = tools[0].row;
  CHECK(rough.name == "MILL_D8");
  CHECK(rough.locked);
  CHECK(rough.l == 0);
  REQUIRE(rough.lathe.has_value());
  CHECK(*rough.lathe == machine::LatheTool{.zl = 110,
                                           .xl = -35.5,
                                           .dzl = -0.01,
                                           .dxl = 0.02,
                                           .rs = 0.8,
                                           .orientation = 7,
                                           .ori = 90});
  CHECK(tools[2].row.name == "BORING");
  CHECK(tools[2].row.lathe.has_value());
  disk.with("TNC:\\table\\toolturn.trn",
            "BEGIN TOOLTURN .TRN MM\nT   ZL   XL   YL\n6   150  12   3\n[END]\n");
  CHECK(disk.error() ==
        "TNC:\\table\\toolturn.trn: row 6, YL: lathe tools are in the middle of Y here");
}

TEST_CASE("tools come from tool.t; tool 0 and indexed tools are left out") {
  const auto tools = FullDisk().read().tools;
  REQUIRE(tools.size() == 2);
  const machine::Tool& mill = tools[0].row;
  CHECK(mill.number == 5);
  CHECK(mill.name == "MILL_D8");
  CHECK(mill.l == 92.5);
  CHECK(mill.r == 4);
  CHECK(mill.dr == 0);
  CHECK(mill.locked);
  CHECK(mill.teeth == 4);
  CHECK_FALSE(mill.clockwise);
  CHECK_FALSE(mill.is_probe());
  const machine::Tool& probe = tools[1].row;
  CHECK(probe.number == 30);
  CHECK(probe.dr == -0.01);
  CHECK(probe.l_breakage == 0.2);
  CHECK(probe.clockwise);
  CHECK(probe.type == 21);
  CHECK(probe.probe == 2);
}

TEST_CASE("probes come from tchprobe.tp") {
  const auto probes = FullDisk().read().probes;
  REQUIRE(probes.size() == 1);
  const machine::ProbeRow& row = probes[0].row;
  CHECK(row.number == 2);
  CHECK(row.type == "TS460");
  CHECK(row.cal_of1 == 0.012);
  CHECK(row.cal_of2 == -0.004);
  CHECK(row.feed == 300);
  CHECK(row.rapid == 2000);
  CHECK(row.distance == 15);
  CHECK(row.set_up == 3);
  CHECK(row.prepositioning == machine::PrePositioning::MachineRapid);
  CHECK(row.track);
  CHECK(row.reaction == machine::CollisionReaction::EmergencyStop);
}

TEST_CASE("presets come from preset.pr, in the columns of either control") {
  const auto presets = FullDisk().read().presets;
  REQUIRE(presets.size() == 2);
  CHECK(presets[1].number == 5);
  CHECK(presets[1].comment == "vice");
  CHECK(presets[1].frame.origin == machine::Vec3{-100.5, 20, 7.25});
  CHECK(presets[1].frame.basic_rotation_deg.z == 1.5);
  CHECK(presets[1].frame.rotary_offsets_deg.x == 2);
  CHECK(presets[1].locked);
  CHECK_FALSE(presets[0].locked);

  const auto old = Disk()
                       .with("TNC:\\PRESET.PR",
                             "BEGIN PRESET .PR MM\n"
                             "NR      DOC              ROT         X           A\n"
                             "3                        +2          +10         -4\n"
                             "[END]\n")
                       .read()
                       .presets;
  REQUIRE(old.size() == 1);
  CHECK(old[0].frame.basic_rotation_deg.z == 2);
  CHECK(old[0].frame.rotary_offsets_deg.x == -4);
}

TEST_CASE("the folder of the tables goes before the root") {
  FullDisk disk;
  disk.with("TNC:\\tool.t", "BEGIN TOOL .T MM\nT       L\n9       1\n[END]\n");
  CHECK(disk.read().tools.size() == 2);
}

TEST_CASE("lengths of a table in inches become millimetres, blank cells keep their default") {
  const auto tables = Disk()
                          .with("TNC:\\tool.t",
                                "BEGIN TOOL .T INCH\nT       L         R    ANGLE\n"
                                "1       +2        0.5  3\n[END]\n")
                          .with("TNC:\\tchprobe.tp",
                                "BEGIN TCHPROBE .TP INCH\nNO      DIST   SET_UP\n"
                                "1              0.1\n[END]\n")
                          .read();
  CHECK(tables.tools[0].row.l == doctest::Approx(50.8));
  CHECK(tables.tools[0].row.r == doctest::Approx(12.7));
  CHECK(tables.tools[0].row.plunge_angle == 3);
  CHECK(tables.probes[0].row.set_up == doctest::Approx(2.54));
  CHECK(tables.probes[0].row.distance == machine::ProbeRow{}.distance);
}

TEST_CASE("a table that cannot be used names itself and the place") {
  const auto tools = [](std::string_view rows) {
    return Disk()
        .with("TNC:\\table\\TOOL.T",
              "BEGIN TOOL .T MM\nT       L         R         TP_NO\n" + std::string(rows))
        .error();
  };
  CHECK(tools("x       10\n[END]\n") ==
        "TNC:\\table\\TOOL.T: row number must be a whole number; got 'x'");
  CHECK(tools("1       10        1         1.5\n[END]\n") ==
        "TNC:\\table\\TOOL.T: row 1, TP_NO: must be a whole number from 0 to 65535");
  CHECK(tools("1       10        -1\n[END]\n") ==
        "TNC:\\table\\TOOL.T: row 1, radius_mm: must be 0 to 1000");
  CHECK(Disk()
            .with("TNC:\\preset.pr", "BEGIN PRESET .PR MM\nNO      X_OFFS\n1       2\n[END]\n")
            .error() ==
        "TNC:\\preset.pr: row 1, X_OFFS: offsets of the linear axes are not available");
}

/// A disk that counts how often a file is read.
class CountingDisk final : public interpreter::ControlDisk {
 public:
  std::optional<interpreter::ControlFile> find(
      const interpreter::ControlPath& path) const override {
    ++reads;
    return files.find(path);
  }
  std::optional<std::string> revision(const interpreter::ControlPath& path) const override {
    return files.revision(path);
  }
  bool has_directory(std::string_view directory) const override {
    return files.has_directory(directory);
  }

  interpreter::MemoryDisk files;
  mutable int reads = 0;
};

TEST_CASE("the control's tables are read again only when one of them has changed") {
  CountingDisk disk;
  disk.files.write("TNC:\\table\\tool.t", kToolTable);
  disk.files.write("TNC:\\table\\tchprobe.tp", kProbeTable);
  ControlTablesCache cache(disk);
  Allowance unlimited;
  CHECK(cache.read(unlimited).value()->tools.size() == 2);
  const int reads = disk.reads;
  CHECK(cache.read(unlimited).value()->tools.size() == 2);
  CHECK(disk.reads == reads);
  disk.files.write("TNC:\\table\\preset.pr", kPresetTable);
  CHECK(cache.read(unlimited).value()->presets.size() == 2);
  CHECK(disk.reads > reads);
}

}  // namespace
}  // namespace fitgauge::app
