#include "api/measurements/measurement_answer.hpp"

#include "api/measurements/measurement_codec.hpp"

namespace fitgauge::api {

void MeasurementAnswer::expect(std::size_t body_size) {
  constexpr std::size_t kRecordPerRow = 4;  // a record is seldom longer than so many rows
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
  }
}

app::Answer MeasurementAnswer::finish() {
  if (single_) answer_.location = "/v1/measurements/" + first_id_;
  if (wanted_ == Preference::Minimal) {
    answer_.content_type.clear();
  } else if (lists_records()) {
    answer_.body += "]}";
  } else if (!single_) {
    JsonWriter json(answer_.body);
    json.begin_object()
        .member("accepted", count_)
        .member("first_id", first_id_)
        .member("last_id", last_id_);
    write_verdict_counts(json, verdicts_[0], verdicts_[1], verdicts_[2], verdicts_[3]);
    json.end_object();
  }
  return std::move(answer_);
}

}  // namespace fitgauge::api
