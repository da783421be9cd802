#include "service/documents/document_service.hpp"

#include "base/thread.hpp"
#include "db/store/database.hpp"
#include "service/log/leaves.hpp"
#include "service/revisions/revisions.hpp"

namespace fitgauge::app {
namespace {

/// Differences between the kinds.
struct Facts {
  std::string_view noun;
  ErrorCode unknown;
};

const Facts& facts_of(DocumentKind kind) {
  static constexpr Facts kFacts[] = {
      {"uncertainty budget", ErrorCode::UncertaintyUnknown},
      {"gauge in use", ErrorCode::GaugeUnknown},
      {"setup", ErrorCode::SetupUnknown},
      {"plan", ErrorCode::PlanUnknown},
      {"connection", ErrorCode::ConnectionUnknown},
      {"progress of a connection", ErrorCode::ConnectionUnknown},
      {"catalogue", ErrorCode::CatalogueUnknown},
      {"calibration", ErrorCode::GaugeUnknown},
      {"study", ErrorCode::StudyUnknown},
  };
  return kFacts[static_cast<std::size_t>(kind) - 1];
}

std::string called(DocumentKind kind, const std::string& name) {
  return fmt::format("{} '{}'", facts_of(kind).noun, name);
}

Error unknown_document(DocumentKind kind, const std::string& name) {
  return {facts_of(kind).unknown, fmt::format("{} not found: '{}'", facts_of(kind).noun, name)};
}

/// Whether the document may be changed. @errors PreconditionFailed
Result<void> check_change(const DocumentService::Precondition& precondition, DocumentKind kind,
                          const std::string& name, const std::optional<store::Document>& current) {
  if (!precondition ||
      precondition(current ? std::optional<std::string_view>(current->text) : std::nullopt)) {
    return {};
  }
  return precondition_failed(called(kind, name), current.has_value());
}

/// Documents of a centre are changed there. @errors Forbidden
Result<void> check_owner(const Stores& stores, DocumentKind kind, const std::string& name) {
  if (kind != DocumentKind::Setup && kind != DocumentKind::Plan &&
      kind != DocumentKind::Catalogue) {
    return {};
  }
  const auto as = static_cast<store::RevisionKind>(kind);
  if (!stores.revisions.received(as, name)) return {};
  return centre_decides(called(kind, name));
}

/// Checks that neither `users` nor a current document refers to the removed one. @errors
/// DocumentInUse with names
Result<void> check_free(const Stores& stores, DocumentKind kind, const std::string& name,
                        std::vector<std::string> users) {
  struct Use {
    DocumentKind by;
    DocumentKind of;
    std::string_view member;
  };
  static constexpr Use kUses[] = {
      {DocumentKind::GaugeInUse, DocumentKind::Uncertainty, "uncertainty"},
      {DocumentKind::Calibration, DocumentKind::Uncertainty, "uncertainty"},
      {DocumentKind::Plan, DocumentKind::GaugeInUse, "gauge"},
      {DocumentKind::Study, DocumentKind::GaugeInUse, "gauge"},
      {DocumentKind::Connection, DocumentKind::GaugeInUse, "gauge"},
      {DocumentKind::Plan, DocumentKind::Catalogue, "catalogue"}};
  for (const Use& use : kUses) {
    if (use.of != kind) continue;
    add_users(users, stores, use.by,
              [&](const JsonValue& each) { return each.text_of(use.member) == name; });
  }
  return check_unused(called(kind, name), users);
}

Result<NamedDocument> find(const Stores& stores, DocumentKind kind, const std::string& name) {
  auto found = stores.documents.find(kind, name);
  if (!found) return unknown_document(kind, name);
  return *std::move(found);
}

/// The texts of gauges in use that were replaced, the oldest first, with the time of the change.
std::vector<NamedDocument> past_gauges(const Stores& stores) {
  std::vector<NamedDocument> past;
  for (store::Change& change : stores.changes.of_kind("gauge")) {
    if (!change.before) continue;
    past.push_back({.name = std::move(change.name),
                    .text = *std::move(change.before),
                    .modified_at_ns = change.at_ns});
  }
  return past;
}

}  // namespace

void add_users(std::vector<std::string>& users, const Stores& stores, DocumentKind kind,
               const std::function<bool(const JsonValue&)>& names_it) {
  for (const store::Document& document : stores.documents.list(kind)) {
    const auto body = parse_json(document.text);
    if (!body) continue;
    const auto has_one = [&](const JsonValue& list) {
      return std::ranges::any_of(list.items, names_it);
    };
    const JsonValue& workpiece = body->member("workpiece");
    if (!names_it(*body) && !names_it(body->member("set")) &&
        !has_one(body->member("characteristics")) && !has_one(workpiece.member("features")) &&
        !has_one(workpiece.member("fixtures"))) {
      continue;
    }
    const std::string user = kind == DocumentKind::Calibration
                                 ? std::string(gauge_of_calibration(document.name))
                                 : document.name;
    // Calibrations outlive their gauge, and are nobody's then.
    if (kind == DocumentKind::Calibration &&
        !stores.documents.find(store::DocumentKind::GaugeInUse, user)) {
      continue;
    }
    users.push_back(called(kind, user));
  }
}

Error precondition_failed(std::string_view what, bool exists) {
  return {ErrorCode::PreconditionFailed,
          exists ? fmt::format("{} exists and is not as If-Match or If-None-Match asks: read it "
                               "again, and repeat the change",
                               what)
                 : fmt::format("{} does not exist: store it without If-Match", what)};
}

Result<void> check_unused(std::string_view what, const std::vector<std::string>& users) {
  if (users.empty()) return {};
  return Error{
      ErrorCode::DocumentInUse,
      fmt::format("{} is in use by {}: change or delete them first", what, fmt::join(users, ", "))};
}

std::string calibration_name(std::string_view gauge, Timestamp from) {
  return fmt::format("{}@{}", gauge, format_rfc3339(from));
}
std::string_view gauge_of_calibration(std::string_view name) {
  return name.substr(0, name.rfind('@'));
}

void DocumentService::write(Change change, Done<bool> done) {
  database_.writer().submit(
      [change = std::move(change), at = clock_.now().nanoseconds,
       has_centre = has_centre_](Stores& stores) -> Result<bool> {
        if (has_centre) TRY(check_owner(stores, change.kind, change.name));
        TRY(check_change(change.precondition, change.kind, change.name,
                         stores.documents.find(change.kind, change.name)));
        if (change.uncertainty &&
            !stores.documents.find(store::DocumentKind::Uncertainty, *change.uncertainty)) {
          return unknown_document(DocumentKind::Uncertainty, *change.uncertainty);
        }
        if (change.gauge &&
            !stores.documents.find(store::DocumentKind::GaugeInUse, *change.gauge)) {
          return unknown_document(DocumentKind::GaugeInUse, *change.gauge);
        }
        return put_document(stores, {.kind = change.kind,
                                     .name = change.name,
                                     .text = change.text,
                                     .modified_at_ns = at,
                                     .caller = change.caller});
      },
      std::move(done));
}

void DocumentService::read(DocumentKind kind, std::string name, Done<NamedDocument> done) {
  database_.readers().submit(
      [kind, name = std::move(name)](const Stores& stores) { return find(stores, kind, name); },
      std::move(done));
}

void DocumentService::remove(DocumentKind kind, std::string name, Precondition precondition,
                             std::optional<std::string> caller, std::vector<std::string> users,
                             Done<bool> done) {
  database_.writer().submit(
      [kind, name = std::move(name), precondition = std::move(precondition),
       users = std::move(users), caller = std::move(caller), at = clock_.now().nanoseconds,
       has_centre = has_centre_](Stores& stores) -> Result<bool> {
        const auto current = stores.documents.find(kind, name);
        if (!current) return unknown_document(kind, name);
        if (has_centre) TRY(check_owner(stores, kind, name));
        TRY(check_free(stores, kind, name, users));
        TRY(check_change(precondition, kind, name, current));
        return remove_document(stores, kind, name, at, caller);
      },
      std::move(done));
}

void DocumentService::list(DocumentKind kind, Done<std::vector<NamedDocument>> done) {
  database_.readers().submit([kind](const Stores& stores) { return stores.documents.list(kind); },
                             std::move(done));
}

void DocumentService::list_each(std::vector<DocumentKind> kinds, bool has_past,
                                Done<std::vector<std::vector<NamedDocument>>> done) {
  database_.readers().submit(
      [kinds = std::move(kinds), has_past](const Stores& stores) {
        std::vector<std::vector<NamedDocument>> lists;
        for (const DocumentKind kind : kinds) lists.push_back(stores.documents.list(kind));
        if (has_past) lists.push_back(past_gauges(stores));
        return lists;
      },
      std::move(done));
}

Result<NamedDocument> DocumentService::wait_for(DocumentKind kind, const std::string& name) {
  return database_.readers().wait(
      [kind, &name](const Stores& stores) { return find(stores, kind, name); });
}

Result<std::vector<NamedDocument>> DocumentService::wait_for_list(DocumentKind kind) {
  return database_.readers().wait(
      [kind](const Stores& stores) { return stores.documents.list(kind); });
}

Result<bool> DocumentService::write_and_wait(Change change) {
  return wait_for_result<bool>([&](Done<bool> done) { write(std::move(change), std::move(done)); });
}

Result<bool> DocumentService::remove_and_wait(DocumentKind kind, const std::string& name,
                                              std::optional<std::string> caller) {
  return wait_for_result<bool>(
      [&](Done<bool> done) { remove(kind, name, {}, std::move(caller), {}, std::move(done)); });
}

}  // namespace fitgauge::app
