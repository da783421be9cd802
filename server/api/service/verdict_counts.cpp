#include "api/service/verdict_counts.hpp"

#include <limits>
#include <utility>

namespace fitgauge::api {
namespace {

/// What one refresh reads at most; the next goes on.
constexpr std::size_t kRowsOfAStep = 200'000;

}  // namespace

void VerdictCounts::refresh(std::function<void()> done) {
  std::optional<std::int64_t> after;
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(reading_, true)) {
      after = position_.value_or(std::numeric_limits<std::int64_t>::max());
    }
  }
  if (!after) return done();
  struct Read {
    Counts counts{};
    std::int64_t last = 0;
  };
  const auto read = std::make_shared<Read>();
  app::MeasurementQuery everything;
  everything.source.reset();
  everything.history = true;
  measurements_.list(
      everything, *after, kRowsOfAStep,
      [read](const app::Measurement& row) {
        ++read->counts[static_cast<std::size_t>(row.source)]
                      [static_cast<std::size_t>(row.result.verdict)];
        read->last = row.id;
      },
      [self = shared_from_this(), read, done = std::move(done)](Result<app::ListPage> page) {
        self->take(page, read->counts, read->last);
        done();
      });
}

void VerdictCounts::take(const Result<app::ListPage>& page, const Counts& counts,
                         std::int64_t last) {
  const std::lock_guard lock(mutex_);
  reading_ = false;
  if (!page) return;
  if (!position_) {
    position_ = page->as_of;
    return;
  }
  if (last > 0) position_ = last;
  for (std::size_t source = 0; source < kSources; ++source) {
    for (std::size_t verdict = 0; verdict < gauging::kVerdicts; ++verdict) {
      counts_[source][verdict] += counts[source][verdict];
    }
  }
}

void VerdictCounts::write(Exposition& out) const {
  const std::lock_guard lock(mutex_);
  out.counter("fitgauge_measurements_total", "Measurements recorded, by source and verdict");
  for (std::size_t source = 0; source < kSources; ++source) {
    for (std::size_t verdict = 0; verdict < gauging::kVerdicts; ++verdict) {
      out.sample(static_cast<double>(counts_[source][verdict]),
                 {{"source", word(static_cast<app::Source>(source))},
                  {"verdict", word(static_cast<gauging::Verdict>(verdict))}});
    }
  }
}

}  // namespace fitgauge::api
