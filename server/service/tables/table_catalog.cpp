#include "service/tables/table_catalog.hpp"

#include "base/json/json_writer.hpp"
#include "db/store/database.hpp"
#include "service/documents/document_service.hpp"
#include "service/log/leaves.hpp"
#include "service/measurements/measurement_storage.hpp"
#include "service/revisions/revisions.hpp"
#include "service/tables/custom_column.hpp"
#include "tables/standards/standard.hpp"

namespace fitgauge::app {
namespace {

constexpr std::string_view kStandardSource = "ISO 286-1:2010 and ISO 286-2:2010, tables/data";
constexpr std::string_view kChangedEvent = "table.changed";
constexpr std::size_t kMostKept = 8;

TableState failed(const store::TableRevision& revision, std::vector<Error> findings) {
  return {.tables = nullptr, .number = revision.number, .findings = std::move(findings)};
}

/// Checks stored tables before their use: the content matches the stored digest, it obeys the
/// rules, and the standard's cells are the compiled-in ones. Tables with equal digests are equal,
/// so some are kept.
TableState audit(const store::LoadedTables& loaded) {
  static std::mutex mutex;
  static std::map<std::tuple<std::string, Digest, Digest>, TableCatalog::Tables> sound;
  const std::lock_guard lock(mutex);
  if (sound.size() == kMostKept) sound.clear();
  auto& kept = sound[{loaded.revision.id, loaded.revision.digest, loaded.computed}];
  if (kept) return {.tables = kept, .number = loaded.revision.number, .findings = {}};
  if (!loaded.content) return failed(loaded.revision, {loaded.content.error()});
  std::vector<Error> findings = iso286::compare_with_compiled_in(*loaded.content);
  if (findings.empty() && loaded.computed != loaded.revision.digest) {
    findings.push_back({ErrorCode::TablesInconsistent,
                        "a cell of revision " + loaded.revision.id +
                            " differs from what was stored: its digest does not match"});
  }
  auto tables = iso286::ToleranceTables::make(*loaded.content, {loaded.revision.id});
  if (!tables) {
    const std::vector<Error>& broken = tables.error().details;
    findings.insert(findings.end(), broken.begin(), broken.end());
  }
  if (!findings.empty()) return failed(loaded.revision, std::move(findings));
  kept = std::make_shared<const iso286::ToleranceTables>(*std::move(tables));
  return {.tables = kept, .number = loaded.revision.number, .findings = {}};
}

Error inconsistent(const std::vector<Error>& findings) {
  return {ErrorCode::TablesInconsistent,
          "the tolerance tables fail their audit: " + findings.front().message,
          findings.front().where, findings};
}

Error unknown_revision(std::string_view id) {
  return {ErrorCode::RevisionUnknown, fmt::format("table revision not found: '{}'", id)};
}

Result<store::LoadedTables> load_or_import(Stores& stores, Timestamp now) {
  if (auto latest = stores.tables.load_latest()) return *std::move(latest);
  const store::TableImport standard{.content = iso286::compiled_in_tables(),
                                    .source = std::string(kStandardSource),
                                    .parent = {},
                                    .caller = {}};
  TRY(stores.tables.import(standard, now.nanoseconds));
  return stores.tables.load_latest().value();
}

/// The text for readers of events; the name of a column needs no escape in JSON.
std::string change_text(const TableCatalog::ColumnName& column, std::string_view revision) {
  return fmt::format(R"({{"feature":"{}","tolerance_class":"{}","table_revision":"{}"}})",
                     word(column.feature), column.name, revision);
}

auto find_column(std::vector<iso286::CustomColumn>& columns,
                 const TableCatalog::ColumnName& column) {
  return std::ranges::find_if(columns, [&](const iso286::CustomColumn& each) {
    return each.feature == column.feature && each.name == column.name;
  });
}

/// Returns the rows of a column for the log of changes, in the form of requests; none if it does
/// not exist.
std::optional<std::string> column_text(std::vector<iso286::CustomColumn>& columns,
                                       const TableCatalog::ColumnName& column) {
  const auto found = find_column(columns, column);
  if (found == columns.end()) return std::nullopt;
  return api::body_json(api::CustomRows{found->rows});
}

}  // namespace

Result<std::unique_ptr<TableCatalog>> TableCatalog::open(Database& database, const Clock& clock,
                                                         bool has_centre) {
  std::unique_ptr<TableCatalog> catalog(new TableCatalog(database, clock, has_centre));
  const auto loaded = TRY(database.writer().wait(
      [&clock](Stores& stores) { return load_or_import(stores, clock.now()); }));
  TRY(database.readers().wait([&catalog](const Stores& stores) { catalog->remember(stores); }));
  catalog->state_.set(std::make_shared<const TableState>(audit(loaded)));
  return catalog;
}

Result<TableCatalog::Tables> TableCatalog::tables() const {
  const auto current = state();
  if (current->tables != nullptr) return current->tables;
  return inconsistent(current->findings);
}

void TableCatalog::at_revision(std::string revision, Done<Tables> done) {
  const auto current = state();
  if (current->tables != nullptr && current->tables->revision().id == revision) {
    return done(current->tables);
  }
  database_.readers().submit(
      [revision = std::move(revision)](const Stores& stores) -> Result<Tables> {
        const auto loaded = stores.tables.load(std::string_view(revision));
        if (!loaded) return unknown_revision(revision);
        TableState state = audit(*loaded);
        if (state.tables == nullptr) return inconsistent(state.findings);
        return std::move(state.tables);
      },
      std::move(done));
}

void TableCatalog::put_column(iso286::CustomColumn column, Condition condition,
                              std::optional<std::string> caller, Done<ColumnStored> done) {
  if (const auto checked = iso286::check_custom_column(column); !checked) {
    return done(checked.error());
  }
  ColumnName name{column.feature, column.name};
  change(std::move(name), std::move(column), std::move(condition), std::move(caller),
         std::move(done));
}

void TableCatalog::remove_column(iso286::Feature feature, std::string name, Condition condition,
                                 std::optional<std::string> caller, Done<ColumnStored> done) {
  change({feature, std::move(name)}, {}, std::move(condition), std::move(caller), std::move(done));
}

/// @param to none: removes the column
void TableCatalog::change(ColumnName column, std::optional<iso286::CustomColumn> to,
                          Condition condition, std::optional<std::string> caller,
                          Done<ColumnStored> done) {
  struct Changed {
    bool created = false;
    store::TableRevision revision;
    std::shared_ptr<const TableState> state;
  };
  database_.writer().submit(
      [this, column = std::move(column), to = std::move(to), condition = std::move(condition),
       caller = std::move(caller)](Stores& stores) -> Result<Changed> {
        if (has_centre_ && stores.revisions.received(store::RevisionKind::Tables, "")) {
          return centre_decides("the tables with their custom tolerance classes");
        }
        const auto latest = stores.tables.load_latest().value();
        const TableState state = audit(latest);
        if (state.tables == nullptr) return inconsistent(state.findings);
        auto data = latest.content.value();
        auto before = column_text(data.custom_columns, column);
        const bool holds = condition(latest.revision.id, before.has_value());
        const Error changed{ErrorCode::PreconditionFailed,
                            "the tables do not match If-Match or If-None-Match: read them again, "
                            "and repeat the change"};
        const auto found = find_column(data.custom_columns, column);
        const bool exists = found != data.custom_columns.end();
        if (!to && !exists) {
          return Error{ErrorCode::ClassUnknown,
                       fmt::format("the {} table has no custom tolerance class {}",
                                   word(column.feature), column.name)};
        }
        if (!to) {
          data.custom_columns.erase(found);
        } else if (exists) {
          *found = *to;
        } else {
          data.custom_columns.push_back(*to);
        }
        auto after = column_text(data.custom_columns, column);
        if (after == before && !holds) return changed;
        if (after == before) return Changed{false, latest.revision, state_.get()};
        const std::int64_t now = clock_.now().nanoseconds;
        TRY(stores.tables.import({.content = data,
                                  .source = "custom column",
                                  .parent = latest.revision.number,
                                  .caller = caller},
                                 now));
        log_change(stores, {.at_ns = now,
                            .caller = caller,
                            .kind = "tables",
                            .name = fmt::format("{}/{}", word(column.feature), column.name),
                            .before = std::move(before),
                            .after = std::move(after)});
        auto loaded = stores.tables.load_latest().value();
        stores.events.append(kChangedEvent, change_text(column, loaded.revision.id), now);
        // Audits here, so that nothing remains to do between the commit and the first reader.
        auto audited = std::make_shared<const TableState>(audit(loaded));
        // Without a class of ISO 286 in its place.
        if (audited->tables != nullptr && !audited->tables->find_class(column.name)) {
          const auto names_it = [&](const JsonValue& value) {
            const auto designation = iso286::parse_designation(value.text_of("designation"));
            return value.text_of("tolerance_class") == column.name ||
                   (designation && designation->class_name == column.name);
          };
          std::vector<std::string> users;
          for (const DocumentKind by : {DocumentKind::Plan, DocumentKind::Connection})
            add_users(users, stores, by, names_it);
          TRY(check_unused(fmt::format("the custom tolerance class {}", column.name), users));
        }
        // RFC 9110, 13.2.1: this is the last refusal.
        if (!holds) return changed;
        return Changed{!exists, std::move(loaded.revision), std::move(audited)};
      },
      [this, done = std::move(done)](Result<Changed> changed) {
        if (!changed) return done(changed.error());
        const store::TableRevision& revision = changed->revision;
        remember(revision.number, revision.id);
        put_in_force(std::move(changed->state));
        done(ColumnStored{changed->created, revision.id});
      });
}

Result<TableCatalog::Received> TableCatalog::receive(
    Stores& stores, const std::string& id, const std::vector<iso286::CustomColumn>& columns,
    std::int64_t now_ns) {
  const auto latest = stores.tables.load_latest().value();
  const store::TableRevision& before = latest.revision;
  if (before.id == id) return Received{.number = before.number, .id = id, .digest = before.digest};
  auto data = TRY(latest.content);
  const bool had_custom = !data.custom_columns.empty();
  for (const iso286::CustomColumn& column : columns) TRY(iso286::check_custom_column(column));
  data.custom_columns = columns;
  TRY(iso286::ToleranceTables::make(data, {id}));
  const Digest digest = store::digest_of(data);
  if (!id.ends_with("-" + store::shown_digits(digest))) {
    return Error{ErrorCode::TablesInconsistent,
                 "the tables differ from the centre's tables of this revision: use the centre's "
                 "version of fitgauge"};
  }
  const auto imported = TRY(stores.tables.import({.content = std::move(data),
                                                  .source = "centre",
                                                  .parent = before.number,
                                                  .caller = {},
                                                  .id = id},
                                                 now_ns));
  const auto revision_text = [](const std::string& of) {
    return fmt::format(R"({{"table_revision":"{}"}})", of);
  };
  log_change(stores, {.at_ns = now_ns,
                      .kind = "tables",
                      .before = revision_text(before.id),
                      .after = revision_text(id)});
  stores.events.append(kChangedEvent, revision_text(id), now_ns);
  return Received{
      .number = imported.number,
      .id = id,
      .digest = digest,
      .state = std::make_shared<const TableState>(audit(stores.tables.load_latest().value())),
      .replaced_own = had_custom,
      .replaced_id = before.id,
      .replaced_digest = before.digest};
}

void TableCatalog::put_in_force(const Received& received) {
  remember(received.number, received.id);
  put_in_force(received.state);
}

/// Puts tables in force unless newer ones are: another daemon's may be faster.
void TableCatalog::put_in_force(std::shared_ptr<const TableState> state) {
  const std::lock_guard lock(state_mutex_);
  if (const auto current = state_.get(); current && current->number > state->number) return;
  state_.set(std::move(state));
}

void TableCatalog::take(const Stores& stores) {
  const std::int64_t newest = remember(stores);
  if (newest <= state()->number) return;
  put_in_force(std::make_shared<const TableState>(audit(stores.tables.load(newest).value())));
}

std::int64_t TableCatalog::remember(const Stores& stores) {
  std::int64_t newest = 0;
  for (const auto& revision : stores.tables.list()) {
    remember(revision.number, revision.id);
    newest = revision.number;
  }
  for (const auto& revision : stores.origins.revisions()) remember(-revision.number, revision.id);
  return newest;
}

void TableCatalog::remember(std::int64_t number, std::string_view id) {
  const std::lock_guard lock(ids_mutex_);
  ids_.emplace(number, id);
}

std::string_view TableCatalog::revision_id(std::int64_t number) const {
  const std::lock_guard lock(ids_mutex_);
  const auto found = ids_.find(number);
  return found == ids_.end() ? std::string_view() : found->second;
}

Result<void> TableCatalog::number_standards() {
  std::set<std::string_view> revisions;
  for (const standards::Standard& standard : standards::all()) {
    if (!standard.designation.empty()) revisions.insert(standard.revision);
  }
  return number_revisions(std::move(revisions));
}

Result<void> TableCatalog::number_revisions(std::set<std::string_view> ids) {
  std::erase_if(ids, [this](std::string_view id) { return id.empty() || revision_number(id); });
  if (ids.empty()) return {};
  const auto numbers = TRY(database_.writer().wait([&](Stores& stores) {
    std::map<std::int64_t, std::string_view> added;
    for (const std::string_view id : ids) added.emplace(-stores.origins.add_revision(id), id);
    return added;
  }));
  for (const auto& [number, id] : numbers) remember(number, id);
  return {};
}

std::optional<std::int64_t> TableCatalog::revision_number(std::string_view id) const {
  const std::lock_guard lock(ids_mutex_);
  // Reversed: prefers a revision of this folder to the same one of another folder.
  const auto found = std::find_if(ids_.rbegin(), ids_.rend(),
                                  [&](const auto& known) { return known.second == id; });
  return found == ids_.rend() ? std::nullopt : std::optional(found->first);
}

}  // namespace fitgauge::app
