#include "api/service/metrics.hpp"

#include "api/services.hpp"

namespace fitgauge::api {
namespace {

void append_number(std::string& out, double value) {
  if (std::isinf(value)) {
    out += value > 0 ? "+Inf" : "-Inf";
    return;
  }
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
  out.append(std::begin(digits), end);
}

void append_label(std::string& out, std::string_view name, std::string_view value) {
  out += out.back() == '{' ? "" : ",";
  out.append(name) += "=\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
  out += '"';
}

constexpr Histogram<15>::Bounds kSeconds = {
    0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 10};

constexpr int kUnauthorized = 401;
constexpr int kServerError = 500;

/// The most rows of one refresh; the next continues.
constexpr std::size_t kRowsOfAStep = 200'000;

}  // namespace

Exposition& Exposition::family(std::string_view name, std::string_view help,
                               std::string_view type) {
  family_ = name;
  out_.append("# HELP ").append(name).append(" ").append(help).append("\n");
  out_.append("# TYPE ").append(name).append(" ").append(type).append("\n");
  return *this;
}

Exposition& Exposition::sample(double value, Labels labels) {
  line("", labels, {}, value);
  return *this;
}

void Exposition::line(std::string_view suffix, Labels labels, std::optional<double> bound,
                      double value) {
  out_.append(family_).append(suffix);
  if (labels.size() > 0 || bound) {
    out_ += '{';
    for (const auto& [name, text] : labels) append_label(out_, name, text);
    if (bound) {
      std::string text;
      append_number(text, *bound);
      append_label(out_, "le", text);
    }
    out_ += '}';
  }
  out_ += ' ';
  append_number(out_, value);
  out_ += '\n';
}

Metrics::Metrics() {
  // Alarms need their series from the start: a series that begins with 1 has no increase.
  for (const ErrorCode code : {
#define FITGAUGE_ERROR(name, id, title, status) ErrorCode::name,
#include "base/error_codes.inc"
#undef FITGAUGE_ERROR
       }) {
    const int status = status_of(code);
    if (status == kUnauthorized || status >= kServerError) problems_[code] = 0;
  }
}

void Metrics::count(const http::FinishedRequest& request) {
  const Key key{request.route.data(), request.request.method(), request.status};
  const std::lock_guard lock(mutex_);
  auto [found, is_new] = requests_.try_emplace(key);
  Requests& requests = found->second;
  if (is_new) {
    auto& [route, seconds] = *seconds_.try_emplace(std::string(request.route), kSeconds).first;
    requests.route = route;
    requests.seconds = &seconds;
  }
  ++requests.count;
  requests.seconds->observe(static_cast<double>(request.microseconds) / 1e6);
}

void Metrics::count(ErrorCode code) {
  const std::lock_guard lock(mutex_);
  ++problems_[code];
}

void Metrics::add(Source source) {
  const std::lock_guard lock(mutex_);
  sources_.push_back(std::move(source));
}

std::string Metrics::text() const {
  Exposition out;
  std::vector<Source> sources;
  out.gauge("fitgauge_build_info", "1, with the version as a label")
      .sample(1, {{"version", kVersion}});
  {
    const std::lock_guard lock(mutex_);
    out.counter("fitgauge_http_requests_total", "Answered requests by route, method and status");
    for (const auto& [key, requests] : requests_) {
      // A method the service does not know is the client's text: it must not become a label.
      const http::Method method = std::get<http::Method>(key);
      out.sample(requests.count,
                 {{"route", requests.route},
                  {"method", method == http::Method::Other ? "other" : http::name(method)},
                  {"status", std::to_string(std::get<int>(key))}});
    }
    out.histogram("fitgauge_http_request_duration_seconds",
                  "From a request's first byte to its answer's last byte");
    for (const auto& [route, seconds] : seconds_) out.sample(seconds, {{"route", route}});
    out.counter("fitgauge_problems_total", "Problem documents answered, by their code");
    for (const auto& [code, count] : problems_) out.sample(count, {{"code", id(code)}});
    sources = sources_;
  }
  for (const Source& source : sources) source(out);
  return out.take();
}

void VerdictCounts::refresh(std::function<void()> done) {
  std::optional<std::int64_t> after;
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(reading_, true))
      after = position_.value_or(std::numeric_limits<std::int64_t>::max());
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
    for (std::size_t verdict = 0; verdict < gauging::kVerdicts; ++verdict)
      counts_[source][verdict] += counts[source][verdict];
  }
}

void VerdictCounts::write(Exposition& out) const {
  const std::lock_guard lock(mutex_);
  out.counter("fitgauge_measurements_total", "Measurements recorded, by source and verdict");
  for (std::size_t source = 0; source < kSources; ++source) {
    for (std::size_t verdict = 0; verdict < gauging::kVerdicts; ++verdict) {
      out.sample(counts_[source][verdict],
                 {{"source", word(static_cast<app::Source>(source))},
                  {"verdict", word(static_cast<gauging::Verdict>(verdict))}});
    }
  }
}

}  // namespace fitgauge::api
