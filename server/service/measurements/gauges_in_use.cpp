#include "service/measurements/gauges_in_use.hpp"

#include "service/documents/document_service.hpp"
#include "service/measurements/uncertainty_budget.hpp"

namespace fitgauge::api {
namespace {

using Documents = std::vector<app::NamedDocument>;

// Documents were checked before they were stored; an unreadable one was altered, and counts as
// absent.

std::map<std::string, metrology::CombinedUncertainty> combined_of(const Documents& budgets) {
  std::map<std::string, metrology::CombinedUncertainty> combined;
  for (const app::NamedDocument& document : budgets) {
    const auto body = parse_json(document.text);
    if (!body) continue;
    const auto found = combined_uncertainty(*body);
    if (found) combined.emplace(document.name, *found);
  }
  return combined;
}

/// Gives a period the budget with that name.
void set_budget(GaugePeriod& period, std::string name,
                const std::map<std::string, metrology::CombinedUncertainty>& combined) {
  period.budget = std::move(name);
  const auto found = combined.find(period.budget);
  if (found == combined.end()) return;
  period.standard_uncertainty = gauging::rounded_up(found->second.combined);
  const double degrees = found->second.degrees_of_freedom * 1e6;
  period.degrees_of_freedom.reset();
  if (degrees <= static_cast<double>(app::kDegreesOfFreedom.most)) {
    period.degrees_of_freedom = static_cast<std::int64_t>(degrees);
  }
}

/// Sets the due date of a gauge, and its budget, with the u it has now, if `text` names a stored
/// one. Else the period keeps its budget. @returns whether it has a date
bool take_gauge(GaugePeriod& period, const std::string& text,
                const std::map<std::string, metrology::CombinedUncertainty>& combined) {
  const auto body = parse_json(text);
  if (!body) return false;
  period.calibration_due = due_in_utc(body->text_of("calibration_due")).value_or("");
  period.due = parse_due(period.calibration_due);
  const std::string budget(body->text_of("uncertainty"));
  if (combined.contains(budget)) set_budget(period, budget, combined);
  return period.due.has_value();
}

GaugeBook book_of(const Documents& gauges, const Documents& calibrations, const Documents& budgets,
                  const Documents& past) {
  const auto combined = combined_of(budgets);
  GaugeBook book;
  for (const app::NamedDocument& document : gauges) {
    GaugeInUse gauge;
    if (take_gauge(gauge.periods.front(), document.text, combined)) {
      book.emplace(document.name, std::move(gauge));
    }
  }
  // The present state of a gauge counts from its last change on; a deleted gauge has none.
  GaugeBook deleted;
  for (const app::NamedDocument& document : past) {
    const auto found = book.find(document.name);
    GaugeInUse& gauge = found != book.end() ? found->second : deleted[document.name];
    if (found == book.end()) gauge.deleted_at = Timestamp{document.modified_at_ns};
    GaugePeriod& now = gauge.periods.back();
    GaugePeriod before = now;
    now.from = {document.modified_at_ns};
    if (take_gauge(before, document.text, combined)) {
      gauge.periods.insert(gauge.periods.end() - 1, std::move(before));
    }
  }
  for (auto& [name, gauge] : deleted) {
    gauge.periods.pop_back();
    if (!gauge.periods.empty()) book.emplace(name, std::move(gauge));
  }
  std::map<std::string_view, std::vector<GaugePeriod>> calibrated;
  for (const app::NamedDocument& document : calibrations) {
    const auto gauge = book.find(app::gauge_of_calibration(document.name));
    const auto body = parse_json(document.text);
    const auto from = body ? parse_from(body->text_of("from")) : std::nullopt;
    if (gauge == book.end() || !from) continue;
    GaugePeriod period = {.from = *from,
                          .calibration_due = due_in_utc(body->text_of("due")).value_or("")};
    period.due = parse_due(period.calibration_due);
    period.is_blocked = body->text_of("status") == "blocked";
    if (body->find("certificate") != nullptr) period.certificate = body->text_of("certificate");
    if (body->find("laboratory") != nullptr) period.laboratory = body->text_of("laboratory");
    const std::string budget = std::string(body->text_of("uncertainty"));
    set_budget(period, budget.empty() ? gauge->second.periods.back().budget : budget, combined);
    calibrated[gauge->first].push_back(std::move(period));
  }
  for (auto& [name, periods] : calibrated) {
    std::ranges::sort(periods, {}, &GaugePeriod::from);
    std::vector<GaugePeriod>& all = book.find(name)->second.periods;
    std::erase_if(all, [&](const GaugePeriod& own) { return periods.front().from <= own.from; });
    std::ranges::move(periods, std::back_inserter(all));
  }
  return book;
}

}  // namespace

void GaugesInUse::reload(std::function<void(Result<void>)> done) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++begun_;
  }
  const auto shared = std::make_shared<std::function<void(Result<void>)>>(std::move(done));
  using app::DocumentKind;
  documents_.list_each(
      {DocumentKind::GaugeInUse, DocumentKind::Calibration, DocumentKind::Uncertainty}, true,
      [this, number, shared](const Result<std::vector<Documents>>& lists) {
        if (!lists) return (*shared)(lists.error());
        show(number, book_of((*lists)[0], (*lists)[1], (*lists)[2], (*lists)[3]));
        (*shared)({});
      });
}

Result<void> GaugesInUse::load() {
  return wait_for_result<void>([this](auto done) { reload(std::move(done)); });
}

void GaugesInUse::show(std::uint64_t number, GaugeBook book) {
  const std::lock_guard lock(mutex_);
  if (number < shown_) return;
  shown_ = number;
  book_.set(std::make_shared<const GaugeBook>(std::move(book)));
}

}  // namespace fitgauge::api
