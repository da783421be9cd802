#include <doctest/doctest.h>

#include <future>
#include <latch>

#include "service_fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::app;

namespace {

using Page = EventService::Page;
using Place = EventService::Place;

constexpr Place kFromTheFirst{.after = EventPosition{}, .source = {}};

std::atomic<int> written{0};
/// Done once while an event is written.
std::function<void()> meanwhile;

void write(std::string& text, const Event& event) {
  ++written;
  text.append(event.type).append(" ");
  if (const auto act = std::exchange(meanwhile, nullptr)) act();
}

std::future<Page> read(Service& service, const Place& place) {
  const auto promise = std::make_shared<std::promise<Page>>();
  service->events().read(place, write,
                         [promise](const Result<Page>& page) { promise->set_value(page.value()); });
  return promise->get_future();
}

/// Keeps the threads that read from beginning with anything else.
class BusyReaders {
 public:
  explicit BusyReaders(Service& service) {
    for (const Source source : {Source::Gauge, Source::Simulation}) {
      service->events().read({.after = {}, .source = source}, write, [this](const Result<Page>&) {
        busy_.count_down();
        free_.wait();
      });
    }
    busy_.wait();
  }
  void end() { free_.count_down(); }

 private:
  std::latch busy_{2};
  std::latch free_{1};
};

}  // namespace

TEST_CASE("readers of events at the same place share a page") {
  Service service;
  service.record(3);
  written = 0;
  BusyReaders busy(service);
  std::vector<std::future<Page>> pages;
  pages.reserve(50);
  for (int i = 0; i < 50; ++i) pages.push_back(read(service, kFromTheFirst));
  auto another = read(service, {.after = EventPosition{.measurement = 2}, .source = {}});
  busy.end();
  for (auto& asked : pages) {
    const Page page = asked.get();
    CHECK(page.text == "measurement.recorded measurement.recorded measurement.recorded ");
    CHECK(page.position.measurement == 3);
    CHECK_FALSE(page.more);
  }
  CHECK(another.get().text == "measurement.recorded ");
  CHECK(written == 4);
}

TEST_CASE("a reader that asks after a commit gets no page that was begun before it") {
  Service service;
  service.record(1);
  std::future<Page> later;
  meanwhile = [&] {
    service.record(1);
    later = read(service, kFromTheFirst);
  };
  CHECK(read(service, kFromTheFirst).get().position.measurement == 1);
  CHECK(later.get().position.measurement == 2);
}

TEST_CASE("a page has no more than 200 measurements, and says that there are more") {
  Service service;
  service.record(201);
  const Page first = read(service, kFromTheFirst).get();
  CHECK(first.position.measurement == 200);
  CHECK(first.more);
  const Page second = read(service, {.after = first.position, .source = {}}).get();
  CHECK(second.position.measurement == 201);
  CHECK_FALSE(second.more);
}
