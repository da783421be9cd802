#include "service/log/leaves.hpp"

#include "base/json/json_writer.hpp"
#include "proof/frontier.hpp"
#include "record/record.hpp"
#include "service/documents/document_service.hpp"

namespace fitgauge::app {
namespace {

/// Checks of the store for rows that no version of the service has written.
std::string_view refusal_of(const Measurement& m) {
  const Length u = m.standard_uncertainty.value_or(Length());
  for (const auto& uncertainty :
       {m.temperature_uncertainty, m.scale_temperature_uncertainty, m.part_expansion_uncertainty,
        m.scale_expansion_uncertainty, m.added_uncertainty, std::optional(u.count())}) {
    if (uncertainty.value_or(0) < 0) return "has an uncertainty below 0";
  }
  if (m.added_uncertainty && !m.corrected)
    return "has the uncertainty of a correction that it lacks";
  if (m.conformance && (m.conformance->probability < 0 || m.conformance->guard_band < 0 ||
                        m.conformance->probability > 1'000'000'000)) {
    return "has a probability out of range";
  }
  if (!m.cycle && m.measured <= Length() && !(m.quantity && gauging::is_signed(*m.quantity))) {
    return "has no size";
  }
  if (m.deviations.upper < m.deviations.lower) return "has its upper limit below its lower limit";
  const bool is_of_class = m.basis != LimitsBasis::Explicit && m.is_judged();
  if (is_of_class != m.class_name.has_value() || is_of_class == m.table_revision.empty()) {
    return "has two sources of its limits";
  }
  if (m.correction_of.has_value() != m.correction_reason.has_value()) {
    return "is a correction without its measurement or reason";
  }
  if (m.conformance.has_value() != (m.rule.kind() == gauging::DecisionRule::Kind::Conformance)) {
    return "has figures of another rule";
  }
  if (!m.is_judged() && m.standard_uncertainty) return "has an uncertainty without limits";
  if (m.rule.kind() == gauging::DecisionRule::Kind::GuardBand && !m.coverage_factor) {
    return "has no coverage factor";
  }
  Measurement again = m;
  judge(again);
  return again.result.verdict == m.result.verdict ? ""
                                                  : "has a verdict that its limits do not give";
}

constexpr std::size_t kLongestEntry = 65'535;

/// Returns the word of the kind in lists of changes; empty: its changes are not logged.
std::string_view word(store::DocumentKind kind) {
  constexpr std::string_view kWords[] = {"budget", "gauge",     "setup",       "plan", "connection",
                                         "",       "catalogue", "calibration", "study"};
  return kWords[static_cast<std::size_t>(kind) - 1];
}

std::string shown_text(store::DocumentKind kind, const std::string& text) {
  const auto settings =
      kind == store::DocumentKind::Connection ? parse_json(text) : Result<JsonValue>(JsonValue());
  if (!settings || settings->is(JsonValue::Kind::Null)) return settings ? text : "{}";
  return api::json_text(without_secrets(*settings));
}

void log_document(Stores& stores, store::DocumentKind kind, const std::string& name,
                  std::int64_t at_ns, const std::optional<std::string>& caller,
                  const std::optional<std::string>& after) {
  if (word(kind).empty()) return;
  store::Change change{.at_ns = at_ns, .caller = caller, .kind = std::string(word(kind))};
  change.name = kind == store::DocumentKind::Calibration ? gauge_of_calibration(name) : name;
  if (const auto before = stores.documents.find(kind, name)) {
    change.before = shown_text(kind, before->text);
  }
  if (after) change.after = shown_text(kind, *after);
  log_change(stores, std::move(change));
}

/// RFC 8785 of the members, except the texts, which are copied as stored.
/// @param id its number, or the number with the digits of its history.
std::string text_of(const store::Change& change, const auto& id, bool has_digests = false) {
  std::string text;
  api::JsonWriter json(text);
  const auto write = [&](std::string_view name, std::string_view digest_name,
                         const std::optional<std::string>& value) {
    if (has_digests && value) {
      json.member(digest_name, to_hex(sha256(*value)));
    } else {
      json.key(name).raw(value ? std::string_view(*value) : "null");
    }
  };
  json.begin_object().member("action", change.action);
  write("after", "after_sha256", change.after);
  json.member("at", format_rfc3339({change.at_ns}));
  write("before", "before_sha256", change.before);
  change.caller ? json.member("caller", *change.caller) : json.key("caller").null();
  json.member("id", id).member("kind", change.kind).member("name", change.name);
  json.end_object();
  return text;
}

}  // namespace

std::span<const tlog::Hash> LeafMaker::operator()(std::span<const Measurement> measurements) {
  records_.clear();
  leaves_.clear();
  begins_.clear();
  RecordWriter writer(records_);
  for (const Measurement& measurement : measurements) {
    if (!leaves_.empty()) records_ += ',';
    begins_.push_back(records_.size());
    writer.append(measurement);
    leaves_.push_back(hasher_.leaf(std::string_view(records_).substr(begins_.back())));
  }
  begins_.push_back(records_.size() + 1);  // after a comma that is absent
  return leaves_;
}

std::string_view finding_in(const Measurement& measurement, std::string_view text) {
  if (const std::string_view refusal = refusal_of(measurement); !refusal.empty()) return refusal;
  std::string written;
  append_record(written, measurement);
  if (written == text) return "";
  return "has members that this version does not know: update the centre before its stations";
}

JsonValue without_secrets(JsonValue settings) {
  for (auto& [name, value] : settings.members) {
    if (name == "secrets") {
      name = "secret_count";
      value = {.kind = JsonValue::Kind::Number, .text = std::to_string(value.items.size())};
    } else if (name == "password") {
      name = "password_set";
      value = {.kind = JsonValue::Kind::Boolean, .boolean = true};
    } else if (name == "headers") {
      for (auto& [header, secret] : value.members) secret = JsonValue();
    }
  }
  return settings;
}

std::string change_json(const store::Change& change, const std::string& id) {
  return text_of(change, id);
}

std::string change_entry(const store::Change& change) {
  std::string entry = text_of(change, change.id);
  return entry.size() <= kLongestEntry ? entry : text_of(change, change.id, true);
}

void log_change(Stores& stores, store::Change change) {
  if (change.before == change.after) return;
  change.id = stores.changes.size() + 1;
  const std::string_view gone = change.kind == "key" ? "revoked" : "deleted";
  change.action = !change.before ? "created" : change.after ? "replaced" : gone;
  stores.changes.append(change, tlog::leaf_hash(change_entry(change)));
}

bool put_document(Stores& stores, const store::Document& document) {
  log_document(stores, document.kind, document.name, document.modified_at_ns, document.caller,
               document.text);
  return stores.documents.put(document);
}

bool remove_document(Stores& stores, store::DocumentKind kind, const std::string& name,
                     std::int64_t at_ns, const std::optional<std::string>& caller) {
  log_document(stores, kind, name, at_ns, caller, std::nullopt);
  return stores.documents.remove(kind, name);
}

}  // namespace fitgauge::app
