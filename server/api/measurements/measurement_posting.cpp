#include "api/measurements/measurements.hpp"

#include "service/jobs.hpp"
#include "service/measurements/gauges_in_use.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::api {
namespace {

/// Decoding more than this would keep other connections of the I/O thread waiting.
constexpr std::size_t kLargeBody = std::size_t{64} << 10;

Response response_of(app::Answer answer, Preference applied) {
  Response response = api::response_of(std::move(answer));
  if (applied == Preference::Minimal) response.with("Preference-Applied", "return=minimal");
  if (applied == Preference::Representation)
    response.with("Preference-Applied", "return=representation");
  return response;
}

/// The basis of verdicts: the current tables and gauges in use.
struct Basis {
  app::TableCatalog::Tables tables;
  std::shared_ptr<const GaugeBook> gauges;
};

Result<Basis> basis_of(const Services& services) {
  const auto tables = TRY(services.tables.tables());
  return Basis{.tables = tables, .gauges = services.gauges.book()};
}

BatchContext context_of(const Posting& posting, const Basis& basis) {
  return {.tables = *basis.tables,
          .received_at = posting.services.clock.now(),
          .caller = caller_name(posting.request),
          .gauges = basis.gauges.get()};
}

void judge_and_record(const SharedPosting& posting) {
  const auto basis = TRY_OR_FAIL(posting->responder, basis_of(posting->services));
  const Request& request = posting->request;
  MeasurementBatch batch;
  TRY_OR_FAIL(posting->responder, decode_measurements(request.body(), request.media_type(),
                                                      context_of(*posting, basis), batch));
  // The class names of the rows are views of the tables, the names of budgets views of the gauges.
  batch.texts = std::make_shared<std::pair<std::shared_ptr<const void>, Basis>>(
      std::move(batch.texts), basis);
  record(posting, std::move(batch));
}

/// Judges on a thread that may block: the first rows are stored while the last are being read.
Result<void> judge_while_recording(const SharedPosting& posting) {
  const auto basis = TRY(basis_of(posting->services));
  const Request& request = posting->request;
  const Preference wanted = preference_of(request);
  MeasurementAnswer rendering(wanted);
  rendering.expect(request.body().size());
  MeasurementBatch batch;
  const auto read = [&](const app::MeasurementService::Take& take) -> Result<void> {
    BatchContext context = context_of(*posting, basis);
    context.take = take;
    auto decoded = decode_measurements(request.body(), request.media_type(), context, batch);
    rendering.set_single(batch.single);
    if (decoded && !batch.rows.empty()) take(std::move(batch.rows));
    return decoded;
  };
  auto answer =
      posting->services.measurements.record_while_reading(read, posting->scope, rendering);
  // The exact reader runs outside the job, so that the writer is free for other requests.
  if (batch.wants_whole) {
    // Usually finds an error without holding the rows, which need more memory than the body.
    BatchContext context = context_of(*posting, basis);
    context.is_exact = true;
    context.take = [](const std::vector<app::Measurement>&) {};
    batch = {};
    TRY(decode_measurements(request.body(), request.media_type(), context, batch));
    batch = {};
    judge_and_record(posting);
    return {};
  }
  if (!answer) return answer.error();
  posting->responder.answer(response_of(*std::move(answer), wanted));
  return {};
}

void judge_where_it_may_take_long(const SharedPosting& posting) {
  if (posting->request.body().size() <= kLargeBody) return judge_and_record(posting);
  posting->services.jobs.bulk.run([posting] { return judge_while_recording(posting); },
                                  [posting](const Result<void>& read) {
                                    if (!read) posting->responder.fail(read.error());
                                  });
}

}  // namespace

void post_once(const Services& services, const Request& request, Responder responder,
               std::function<void(const SharedPosting&)> first_time) {
  const SharedPosting posting = begin_posting(services, request, std::move(responder));
  if (!posting) return;
  if (!posting->scope) return first_time(posting);
  services.measurements.find_answer(*posting->scope, [posting, first_time = std::move(first_time)](
                                                         Result<std::optional<app::Answer>> kept) {
    if (!kept) return posting->responder.fail(kept.error());
    if (!*kept) return first_time(posting);
    posting->responder.answer(replayed(**std::move(kept)));
  });
}

void record(const SharedPosting& posting, MeasurementBatch batch) {
  const Preference wanted = preference_of(posting->request);
  posting->services.measurements.record(
      std::move(batch.rows), posting->scope,
      [single = batch.single, wanted] {
        auto rendering = std::make_unique<MeasurementAnswer>(wanted);
        rendering->set_single(single);
        return rendering;
      },
      [posting, wanted, texts = std::move(batch.texts)](Result<app::Answer> answer) {
        if (!answer) return posting->responder.fail(answer.error());
        posting->responder.answer(response_of(*std::move(answer), wanted));
      });
}

void post_measurements(const Services& services, const Request& request, Responder responder) {
  post_once(services, request, std::move(responder), judge_where_it_may_take_long);
}

std::vector<Warning> warnings_of(const app::Measurement& m) {
  using Kind = gauging::DecisionRule::Kind;
  std::vector<Warning> warnings;
  const bool has_tolerance = m.has_upper_limit() && m.has_lower_limit();
  const Length tolerance = m.deviations.upper - m.deviations.lower;
  if (has_tolerance) warn_of_no_acceptance(m.rule, tolerance, warnings);
  if (has_tolerance && m.rule.kind() == Kind::Simple && m.standard_uncertainty &&
      *m.standard_uncertainty * 10 > tolerance) {
    warnings.push_back({"uncertainty.large",
                        fmt::format("uncertainty_um of {} is above a tenth of the tolerance of {} "
                                    "um, and rule simple ignores it: use guard_band or conformance",
                                    format_um(*m.standard_uncertainty), format_um(tolerance))});
  }
  if (m.has_unknown_gauge) {
    warnings.push_back(
        {"gauge.unknown", fmt::format("gauge '{}' is not among the gauges in use: register it, or "
                                      "correct its name",
                                      m.gauge.value_or(""))});
  }
  if (m.gauge_blocked) {
    warnings.push_back(
        {"gauge.blocked", fmt::format("gauge '{}' was blocked at the time of measuring: measure "
                                      "again with another gauge, or record its calibration",
                                      m.gauge.value_or(""))});
  }
  if (m.calibration_due) {
    warnings.push_back(
        {"gauge.overdue", fmt::format("the calibration of gauge '{}' was due {}: record the next "
                                      "one, or measure again",
                                      m.gauge.value_or(""), *m.calibration_due)});
  }
  return warnings;
}

void MeasurementAnswer::expect(std::size_t body_size) {
  constexpr std::size_t kRecordPerRow = 4;  // a record is rarely longer than this for each row
  if (wanted_ == Preference::Representation) answer_.body.reserve(kRecordPerRow * body_size);
}

void MeasurementAnswer::add(std::span<const app::Measurement> measurements,
                            std::string_view records) {
  const auto id_of = [](const app::Measurement& m) {
    return app::measurement_id_text(m.id, m.origin);
  };
  if (count_ == 0) first_id_ = id_of(measurements.front());
  if (!single_) last_id_ = id_of(measurements.back());
  if (lists_records()) {
    answer_.body += count_ == 0 ? R"({"measurements":[)" : ",";
    answer_.body += records;
  } else if (single_ && wanted_ != Preference::Minimal) {
    answer_.body += records;
  }
  count_ += static_cast<std::int64_t>(measurements.size());
  for (const app::Measurement& m : measurements) {
    ++verdicts_.at(static_cast<std::size_t>(m.result.verdict));
    warn_of(m);
  }
}

/// Adds warnings; of a list only the first ones, each with the id of its record, and counts others.
void MeasurementAnswer::warn_of(const app::Measurement& m) {
  constexpr std::size_t kMost = 20;
  for (Warning& warning : warnings_of(m)) {
    if (warnings_.size() == kMost) {
      ++unlisted_warnings_;
      continue;
    }
    if (!single_) {
      warning.detail =
          fmt::format("{}: {}", app::measurement_id_text(m.id, m.origin), warning.detail);
    }
    warnings_.push_back(std::move(warning));
  }
}

void MeasurementAnswer::end_with_warnings() {
  if (!warnings_.empty()) {
    answer_.body += ',';
    std::string members;
    JsonWriter json(members);
    json.begin_object();
    write_warnings(json, warnings_);
    answer_.body.append(members, 1);
  }
  answer_.body += '}';
}

app::Answer MeasurementAnswer::finish() {
  if (unlisted_warnings_ > 0) {
    warnings_.back().detail += fmt::format(
        "; {} more warnings are not listed: check the measurements after it", unlisted_warnings_);
  }
  if (single_) answer_.location = "/v1/measurements/" + first_id_;
  if (wanted_ == Preference::Minimal) {
    answer_.content_type.clear();
  } else if (lists_records()) {
    answer_.body += ']';
    end_with_warnings();
  } else if (!single_) {
    JsonWriter json(answer_.body);
    json.begin_object()
        .member("accepted", count_)
        .member("first_id", first_id_)
        .member("last_id", last_id_);
    write_verdict_counts(json, verdicts_);
    write_warnings(json, warnings_);
    json.end_object();
  } else if (!warnings_.empty()) {
    answer_.body.pop_back();
    end_with_warnings();
  }
  return std::move(answer_);
}

}  // namespace fitgauge::api
