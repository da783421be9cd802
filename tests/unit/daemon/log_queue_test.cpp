#include "daemon/log.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <sstream>

using namespace fitgauge::daemon;
using std::chrono::seconds;
using std::chrono::steady_clock;

namespace {

using Kind = LogQueue::Kind;

/// A pipe whose reader reads when the test says so.
class Pipe {
 public:
  Pipe() {
    REQUIRE(pipe2(ends_, O_CLOEXEC) == 0);
    REQUIRE(fcntl(ends_[0], F_SETFL, O_NONBLOCK) == 0);
  }
  ~Pipe() {
    close(ends_[0]);
    close(ends_[1]);
  }
  int write_end() const { return ends_[1]; }

  /// Reads until `complete` is content with all that came, or nothing has come for ten seconds.
  template <class Complete>
  std::string read_until(Complete complete) const {
    std::string all;
    char bytes[1 << 16];
    while (!complete(all)) {
      pollfd wanted{.fd = ends_[0], .events = POLLIN, .revents = 0};
      if (poll(&wanted, 1, 60'000) != 1) break;
      const ssize_t count = read(ends_[0], bytes, sizeof bytes);
      if (count <= 0) break;
      all.append(bytes, static_cast<std::size_t>(count));
    }
    return all;
  }
  std::string read_until(const char* text) const {
    return read_until([&](const std::string& all) { return all.find(text) != std::string::npos; });
  }

 private:
  int ends_[2] = {-1, -1};
};

std::string line(int number) { return "line " + std::to_string(number) + '\n'; }

/// The lines of `line`, and how many others the log says it has lost.
struct Heard {
  std::uint64_t lines = 0;
  std::uint64_t lost = 0;
};

Heard heard(const std::string& text) {
  Heard heard;
  std::istringstream in(text);
  for (std::string each; std::getline(in, each);) {
    if (each.starts_with("line ")) ++heard.lines;
    const std::size_t said = each.find("\"detail\":\"");
    if (said != std::string::npos) heard.lost += std::stoull(each.substr(said + 10));
  }
  return heard;
}

}  // namespace

TEST_CASE("lines arrive in order, each whole, also those longer than a pipe's piece") {
  const Pipe pipe;
  std::string expected;
  {
    LogQueue queue(pipe.write_end());
    for (int i = 0; i < 100; ++i) {
      std::string text = std::string(static_cast<std::size_t>(i) * 100, 'x') + line(i);
      queue.push(text, Kind::Request);
      expected += text;
    }
    CHECK(pipe.read_until("line 99\n") == expected);
    CHECK(queue.lost() == 0);
  }
}

TEST_CASE("nobody reads: who logs never waits, what finds no room is counted and said later") {
  constexpr int kLines = 100'000;
  const Pipe pipe;
  LogQueue queue(pipe.write_end(), 1 << 16);
  for (int i = 0; i < kLines; ++i) queue.push(line(i), Kind::Request);
  CHECK(queue.lost() > 0);
  const std::string text = pipe.read_until([&](const std::string& all) {
    const Heard so_far = heard(all);
    return all.ends_with('\n') && so_far.lines + so_far.lost >= kLines;
  });
  CHECK(heard(text).lost == queue.lost());
  CHECK(heard(text).lines == kLines - queue.lost());
}

TEST_CASE("requests leave room for what matters more") {
  const Pipe pipe;
  LogQueue queue(pipe.write_end(), 1 << 16);
  for (int i = 0; i < 100'000; ++i) queue.push(line(i), Kind::Request);
  const auto lost = queue.lost();
  REQUIRE(lost > 0);
  queue.push("the disk is full\n", Kind::Other);
  CHECK(queue.lost() == lost);
  // What was lost is said behind it, maybe in the same read.
  CHECK(pipe.read_until("the disk is full\n").find("the disk is full\n") != std::string::npos);
}

TEST_CASE("a reader that never comes back does not hold the end") {
  const Pipe pipe;
  const auto begin = steady_clock::now();
  {
    LogQueue queue(pipe.write_end());
    for (int i = 0; i < 100'000; ++i) queue.push(line(i), Kind::Request);
  }
  CHECK(steady_clock::now() - begin < seconds(30));  // not for ever
}

TEST_CASE("a file gets every line before the queue is gone") {
  char name[] = "/tmp/fitgauge-log-XXXXXX";
  const int file = mkstemp(name);
  REQUIRE(file >= 0);
  {
    LogQueue queue(file);
    std::thread other([&] {
      for (int i = 0; i < 1000; ++i) queue.push(line(i), Kind::Other);
    });
    for (int i = 1000; i < 2000; ++i) queue.push(line(i), Kind::Other);
    other.join();
  }
  std::size_t bytes = 0;
  for (int i = 0; i < 2000; ++i) bytes += line(i).size();
  CHECK(lseek(file, 0, SEEK_CUR) == static_cast<off_t>(bytes));
  close(file);
  unlink(name);
}

TEST_CASE("what cannot be written is lost, not tried for ever") {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  REQUIRE(full >= 0);
  LogQueue queue(full);
  queue.push(line(1), Kind::Other);
  while (queue.lost() == 0) std::this_thread::yield();
  CHECK(queue.lost() >= 1);
  close(full);
}

TEST_CASE("the queue's thread takes no signal of the process") {
  const Pipe pipe;
  const LogQueue queue(pipe.write_end());
  sigset_t one;
  sigset_t before;
  sigemptyset(&one);
  sigaddset(&one, SIGTERM);
  REQUIRE(pthread_sigmask(SIG_BLOCK, &one, &before) == 0);
  kill(getpid(), SIGTERM);  // were the thread to take it, the process would end
  int taken = 0;
  CHECK(sigwait(&one, &taken) == 0);
  CHECK(taken == SIGTERM);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}
