#include "base/folder.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include "support/files.hpp"

using namespace fitgauge;

namespace {

namespace fs = std::filesystem;

struct Shared : TemporaryFolder {
  Shared() {
    fs::create_directory(path() / "in");
    fs::create_directory(path() / "secret");
    put("in/a.csv", "a");
  }

  void put(const std::string& name, std::string_view text) const {
    write_file(path() / name, text);
  }
  std::string text_of(const std::string& name) const { return content_of(path() / name); }
  Folder folder() const { return *Folder::open(path() / "in"); }
  std::set<std::string> names(const std::string& folder) const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(path() / folder)) {
      found.insert(entry.path().filename());
    }
    return found;
  }
};

}  // namespace

TEST_CASE_FIXTURE(Shared, "what is no file of the folder is not read, and nothing waits for it") {
  REQUIRE(::mkfifo((path() / "in/fifo.csv").c_str(), 0600) == 0);
  fs::create_symlink(path() / "in/a.csv", path() / "in/link.csv");
  fs::create_directory(path() / "in/folder.csv");
  const Folder folder = this->folder();
  for (const char* name : {"fifo.csv", "link.csv", "folder.csv", "none.csv"}) {
    CAPTURE(name);
    const auto file = folder.read(name).value();
    CHECK_FALSE(file.has_value());
  }
  const auto file = folder.read("a.csv").value().value();
  std::array<char, 8> bytes{};
  CHECK(::read(file.get(), bytes.data(), bytes.size()) == 1);
}

TEST_CASE_FIXTURE(Shared, "a draft that is a FIFO or a link is replaced, and not written through") {
  REQUIRE(::mkfifo((path() / "in/.out.csv.part").c_str(), 0600) == 0);
  CHECK(folder().write("out.csv", "text").has_value());
  CHECK(text_of("in/out.csv") == "text");
  put("secret/kept", "kept");
  fs::create_symlink(path() / "secret/kept", path() / "in/.out.csv.part");
  CHECK(folder().write("out.csv", "more").has_value());
  CHECK(text_of("in/out.csv") == "more");
  CHECK(text_of("secret/kept") == "kept");
  CHECK(names("in") == std::set<std::string>{"a.csv", "out.csv"});
}

TEST_CASE_FIXTURE(Shared, "a folder that is a link is refused by its name") {
  fs::create_symlink(path() / "secret", path() / "in/done");
  const auto done = folder().sub("done");
  CHECK(done.error().message.find("in/done") != std::string::npos);
  CHECK(done.error().message.find("links are not followed") != std::string::npos);
  CHECK(names("secret").empty());
}

TEST_CASE_FIXTURE(Shared, "a file is moved under the first free name") {
  const auto done = folder().sub("done").value();
  for (const char* expected : {"a.csv", "a.csv.1", "a.csv.2"}) {
    put("in/a.csv", expected);
    CHECK(folder().move("a.csv", done, "a.csv").has_value());
    CHECK(text_of("in/done/" + std::string(expected)) == expected);
  }
  CHECK(folder().move("none", done, "none").error().message.find("No such file or directory") !=
        std::string::npos);
}

TEST_CASE_FIXTURE(Shared, "a folder that is away is named with the cause") {
  CHECK(Folder::open(path() / "away").error().message ==
        "cannot open the folder " + (path() / "away").string() + ": No such file or directory");
}
