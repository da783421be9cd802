#include "base/folder.hpp"

#include <doctest/doctest.h>
#include <stdlib.h>
#include <unistd.h>

#include <fstream>

using namespace fitgauge;

namespace {

namespace fs = std::filesystem;

struct Shared {
  Shared() {
    std::string name = (fs::temp_directory_path() / "fitgauge-folder-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path = name;
    fs::create_directory(path / "in");
    fs::create_directory(path / "secret");
    put("in/a.csv", "a");
  }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  ~Shared() { fs::remove_all(path); }

  void put(const std::string& name, std::string_view text) const {
    std::ofstream(path / name) << text;
  }
  std::string text_of(const std::string& name) const {
    std::ifstream in(path / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  Folder folder() const { return *Folder::open(path / "in"); }
  std::set<std::string> names(const std::string& folder) const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(path / folder)) {
      found.insert(entry.path().filename());
    }
    return found;
  }

  fs::path path;
};

}  // namespace

TEST_CASE_FIXTURE(Shared, "what is no file of the folder is not read, and nothing waits for it") {
  REQUIRE(::mkfifo((path / "in/fifo.csv").c_str(), 0600) == 0);
  fs::create_symlink(path / "in/a.csv", path / "in/link.csv");
  fs::create_directory(path / "in/folder.csv");
  const Folder folder = this->folder();
  for (const char* name : {"fifo.csv", "link.csv", "folder.csv", "none.csv"}) {
    CAPTURE(name);
    const auto file = folder.read(name);
    REQUIRE(file.has_value());
    CHECK_FALSE(file->has_value());
  }
  const auto file = folder.read("a.csv");
  REQUIRE(file.has_value());
  REQUIRE(file->has_value());
  std::array<char, 8> bytes{};
  CHECK(::read((*file)->get(), bytes.data(), bytes.size()) == 1);
}

TEST_CASE_FIXTURE(Shared, "a draft that is a FIFO or a link is replaced, and not written through") {
  REQUIRE(::mkfifo((path / "in/.out.csv.part").c_str(), 0600) == 0);
  CHECK(folder().write("out.csv", "text").has_value());
  CHECK(text_of("in/out.csv") == "text");
  put("secret/kept", "kept");
  fs::create_symlink(path / "secret/kept", path / "in/.out.csv.part");
  CHECK(folder().write("out.csv", "more").has_value());
  CHECK(text_of("in/out.csv") == "more");
  CHECK(text_of("secret/kept") == "kept");
  CHECK(names("in") == std::set<std::string>{"a.csv", "out.csv"});
}

TEST_CASE_FIXTURE(Shared, "a folder that is a link is refused by its name") {
  fs::create_symlink(path / "secret", path / "in/done");
  const auto done = folder().sub("done");
  REQUIRE_FALSE(done.has_value());
  CHECK(done.error().message.find("in/done") != std::string::npos);
  CHECK(done.error().message.find("links are not followed") != std::string::npos);
  CHECK(names("secret").empty());
}

TEST_CASE_FIXTURE(Shared, "a file is moved under the first free name") {
  const auto done = folder().sub("done");
  REQUIRE(done.has_value());
  for (const char* expected : {"a.csv", "a.csv.1", "a.csv.2"}) {
    put("in/a.csv", expected);
    CHECK(folder().move("a.csv", *done, "a.csv").has_value());
    CHECK(text_of("in/done/" + std::string(expected)) == expected);
  }
  const auto missing = folder().move("none", *done, "none");
  REQUIRE_FALSE(missing.has_value());
  CHECK(missing.error().message.find("No such file or directory") != std::string::npos);
}

TEST_CASE_FIXTURE(Shared, "a folder that is away is named with the cause") {
  const auto away = Folder::open(path / "away");
  REQUIRE_FALSE(away.has_value());
  CHECK(away.error().message ==
        "cannot open the folder " + (path / "away").string() + ": No such file or directory");
}
