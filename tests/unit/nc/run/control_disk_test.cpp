#include "nc/program/control_disk.hpp"

#include <doctest/doctest.h>

namespace fitgauge::interpreter {
namespace {

std::string resolved(std::string_view text) {
  const auto program = ControlPath::parse("TNC:\\nc_prog\\8255\\8255.h").value();
  const auto path = ControlPath::resolve(text, program);
  return path.has_value() ? path->text() : std::string(id(path.error().code));
}

TEST_CASE("a path is read as an NC program names it") {
  CHECK(resolved("82551.H") == "TNC:\\nc_prog\\8255\\82551.H");
  CHECK(resolved("TNC:\\table\\x.tab") == "TNC:\\table\\x.tab");
  CHECK(resolved("tnc:/table/x.tab") == "TNC:\\table\\x.tab");
  CHECK(resolved("..\\8210\\8210.h") == "TNC:\\nc_prog\\8210\\8210.h");
  CHECK(resolved(".\\sub\\.\\a.h") == "TNC:\\nc_prog\\8255\\sub\\a.h");
  CHECK(resolved("\\a.h") == "TNC:\\a.h");
}

TEST_CASE("a path that leaves the control's disk is refused") {
  CHECK(resolved("..\\..\\..\\etc\\passwd") == "file.path_invalid");
  CHECK(resolved("TNC:\\..\\etc\\passwd") == "file.path_invalid");
  CHECK(resolved("PLC:\\a.h") == "file.path_invalid");
  CHECK(resolved("C:\\a.h") == "file.path_invalid");
  for (const char* directory :
       {"sub\\", ".", "..", "sub\\.", "sub\\..", "TNC:\\sub\\ .. ", "TNC:", "\\"}) {
    CAPTURE(directory);
    CHECK(resolved(directory) == "file.path_invalid");
  }
  CHECK(resolved("") == "file.path_invalid");
  CHECK(resolved("..\\..") == "file.path_invalid");
  CHECK(resolved("a\nb.h") == "file.path_invalid");
  CHECK(resolved(std::string(300, 'x')) == "file.path_invalid");
  CHECK(ControlPath::parse("8255.h").has_error());
}

TEST_CASE("files are found without regard to case") {
  MemoryDisk disk;
  disk.write("TNC:\\nc_prog\\8255.h", "one");
  const auto file = disk.find(ControlPath::parse("tnc:\\NC_PROG\\8255.H").value());
  REQUIRE(file.has_value());
  CHECK(*file->bytes == "one");
  CHECK(file->path.text() == "TNC:\\nc_prog\\8255.h");
  CHECK(file->source == FileSource::Stored);
  CHECK_FALSE(disk.find(ControlPath::parse("TNC:\\8255.h").value()).has_value());
  CHECK(disk.revision(file->path) == file->revision);
  CHECK_FALSE(disk.revision(ControlPath::parse("TNC:\\8255.h").value()).has_value());
  CHECK(disk.has_directory("TNC:\\NC_prog\\"));
  CHECK_FALSE(disk.has_directory("TNC:\\nc\\"));
}

TEST_CASE("a projected file is found in every directory, an uploaded one of its name wins") {
  MemoryDisk disk;
  const auto projected = std::make_shared<const std::string>("live");
  const ProjectingDisk projecting(disk, {{"82553_hole.tab", projected, "r1"}});
  const auto path = ControlPath::parse("TNC:\\a\\82553_HOLE.TAB").value();
  REQUIRE(projecting.find(path).has_value());
  CHECK(projecting.find(path)->source == FileSource::Live);
  CHECK(projecting.revision(path) == "r1");
  CHECK(*projecting.find(path)->bytes == "live");
  disk.write("TNC:\\a\\82553_hole.tab", "own");
  CHECK(*projecting.find(path)->bytes == "own");
  CHECK(projecting.find(path)->source == FileSource::Stored);
}

}  // namespace
}  // namespace fitgauge::interpreter
