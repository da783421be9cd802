#include "service/revisions/revisions.hpp"

#include "db/store/database.hpp"
#include "record/measurement.hpp"
#include "record/record.hpp"
#include "service/log/leaves.hpp"
#include "service/measurements/measurement_storage.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

constexpr std::int64_t kMostRevisions = 500;
constexpr std::size_t kMostBytes = std::size_t{4} << 20;

constexpr std::pair<RevisionKind, std::string_view> kKinds[] = {
    {RevisionKind::Tables, "tables"},         {RevisionKind::Key, "key"},
    {RevisionKind::Setup, "setup"},           {RevisionKind::Plan, "plan"},
    {RevisionKind::Correction, "correction"}, {RevisionKind::Catalogue, "catalogue"}};

void fill_tables(const Stores& stores, Revision& revision) {
  const auto latest = stores.tables.load_latest();
  if (!latest) return;
  revision.id = latest->revision.id;
  if (latest->content) revision.columns = latest->content->custom_columns;
}

void fill_key(const Stores& stores, Revision& revision) {
  const auto key = stores.keys.newest(revision.name);
  revision.is_removed = !key || key->revoked_at_ns.has_value();
  if (!key) return;
  revision.role = key->role;
  revision.token_hash = key->token_hash;
  if (key->expires_at_ns) revision.expires_at = Timestamp{*key->expires_at_ns};
}

void fill_document(const Stores& stores, Revision& revision) {
  // A document and its revisions have the same codes.
  auto document =
      stores.documents.find(static_cast<store::DocumentKind>(revision.kind), revision.name);
  revision.is_removed = !document;
  if (document) revision.text = std::move(document->text);
}

/// Renames a document that this folder has made to a free name.
std::string keep_own(Stores& stores, store::Document own, std::int64_t now_ns) {
  const std::string name = own.name;
  own.name = name + " (local)";
  for (int i = 2; stores.documents.find(own.kind, own.name); ++i) {
    own.name = fmt::format("{} (local {})", name, i);
  }
  own.modified_at_ns = now_ns;
  put_document(stores, own);
  return own.name;
}

}  // namespace

std::string_view word(RevisionKind kind) {
  return std::ranges::find(kKinds, kind, &std::pair<RevisionKind, std::string_view>::first)->second;
}

std::optional<RevisionKind> revision_kind_from_word(std::string_view text) {
  for (const auto& [kind, name] : kKinds) {
    if (text == name) return kind;
  }
  return std::nullopt;
}

void RevisionFeed::read(std::string_view station, std::string position,
                        Done<RevisionPage> done) const {
  database_.readers().submit([this, station = std::string(station), position = std::move(position)](
                                 const Stores& stores) { return page(stores, station, position); },
                             std::move(done));
}

Result<RevisionPage> RevisionFeed::page(const Stores& stores, std::string_view station,
                                        std::string_view position) const {
  const auto origin = stores.origins.find(station);
  const auto listed = stores.revisions.list(stores.revisions.number_of(position).value_or(0),
                                            origin ? origin->number : 0, kMostRevisions);
  RevisionPage page{.position = stores.revisions.newest_position(),
                    .more = false,
                    .origin = std::string(origins_.own()),
                    .size = origin ? origin->size : 0,
                    .notes = origin ? stores.notes.newest_of(origin->number) : 0,
                    .is_branched = origin && stores.origins.is_base(origin->number)};
  std::size_t bytes = 0;
  for (const auto& [number, kind, name] : listed) {
    if (bytes > kMostBytes) {
      page.more = true;
      break;
    }
    Revision revision{.number = number, .kind = kind};
    if (!fill(stores, name, revision)) continue;
    bytes += revision.text.size();
    page.revisions.push_back(std::move(revision));
  }
  page.more = page.more || listed.size() == static_cast<std::size_t>(kMostRevisions);
  if (page.more) page.position = stores.revisions.position(page.revisions.back().number);
  return page;
}

/// @returns false: it has nothing to send.
bool RevisionFeed::fill(const Stores& stores, const std::string& name, Revision& revision) const {
  if (revision.kind == RevisionKind::Correction) {
    std::int64_t row = 0;
    std::from_chars(name.data(), name.data() + name.size(), row);
    const RowNames names = row_names(tables_, origins_);
    return stores.measurements.find(row, [&](const MeasurementRow& found) {
      append_record(revision.text, from_store(found, names));
      revision.place = found.place_in_log();
    });
  }
  revision.name = name;
  switch (revision.kind) {
    case RevisionKind::Tables: fill_tables(stores, revision); break;
    case RevisionKind::Key: fill_key(stores, revision); break;
    default: fill_document(stores, revision);
  }
  return true;
}

/// A page in its transaction.
struct RevisionIntake::Job {
  Stores& stores;
  TableCatalog& tables;
  const Origins& origins;
  std::int64_t now;

  Outcome outcome{};
  std::optional<TableCatalog::Received> received{};
  std::vector<std::pair<std::string_view, std::string>> told{};

  void refuse(std::string detail) {
    ++outcome.refused;
    told.emplace_back("revision_refused", std::move(detail));
  }

  std::optional<store::RevisionsStore::Received> received_of(const Revision& revision) const {
    return stores.revisions.received(revision.kind, revision.name);
  }
  void set_received(const Revision& revision, const Digest& digest) {
    stores.revisions.set_received(revision.kind, revision.name,
                                  {.number = revision.number, .digest = digest});
  }

  void take(const Revision& revision) {
    switch (revision.kind) {
      case RevisionKind::Tables: return take_tables(revision);
      case RevisionKind::Key: return take_key(revision);
      case RevisionKind::Setup:
      case RevisionKind::Plan:
      case RevisionKind::Catalogue:
        return take_document(revision, static_cast<store::DocumentKind>(revision.kind));
      case RevisionKind::Correction: break;
    }
    take_correction(revision);
  }

  void take_tables(const Revision& revision) {
    auto taken = tables.receive(stores, revision.id, revision.columns, now);
    if (!taken) return refuse(fmt::format("tables {}: {}", revision.id, taken.error().message));
    const auto before = received_of(revision);
    set_received(revision, taken->digest);
    if (!taken->state) return;  // they are in force
    ++outcome.taken;
    if (taken->replaced_own && !(before && before->digest == taken->replaced_digest)) {
      told.emplace_back("revision_replaced",
                        fmt::format("the centre's tables {} replace {}, which has custom classes "
                                    "of this folder and stays readable by its name",
                                    revision.id, taken->replaced_id));
    }
    received = *std::move(taken);
  }

  void take_document(const Revision& revision, store::DocumentKind kind) {
    auto current = stores.documents.find(kind, revision.name);
    const auto before = received_of(revision);
    const bool is_own = current && current->text != revision.text &&
                        !(before && before->digest == sha256(current->text));
    if (revision.is_removed) {
      if (current && before && !is_own) {
        remove_document(stores, kind, revision.name, now, {});
        ++outcome.taken;
      }
      if (before) stores.revisions.forget_received(revision.kind, revision.name);
      return;
    }
    if (is_own) {
      const std::string kept = keep_own(stores, *current, now);
      told.emplace_back(
          "revision_replaced",
          fmt::format("the centre's {} '{}' replaces one of this folder, which was renamed to '{}'",
                      word(revision.kind), revision.name, kept));
    }
    if (!current || current->text != revision.text) {
      put_document(stores, {.kind = kind,
                            .name = revision.name,
                            .text = revision.text,
                            .modified_at_ns = now,
                            .caller = {}});
      ++outcome.taken;
    }
    set_received(revision, sha256(revision.text));
  }

  void take_key(const Revision& revision) {
    const auto current = stores.keys.newest(revision.name);
    const auto before = received_of(revision);
    const bool is_valid = current && !current->revoked_at_ns;
    const bool is_received = before && is_valid && before->digest == current->token_hash;
    if (revision.is_removed || (is_received && current->token_hash != revision.token_hash)) {
      if (is_received && revoke_key(stores, revision.name, now)) ++outcome.taken;
      if (revision.is_removed) return;
    } else if (is_valid && current->token_hash == revision.token_hash) {
      return set_received(revision, revision.token_hash);
    }
    if (!stores.keys.receive(
            revision.name, revision.role, revision.token_hash, now,
            revision.expires_at ? std::optional(revision.expires_at->nanoseconds) : std::nullopt)) {
      return refuse(
          fmt::format("the centre's key '{}': this folder has another valid key of that name, or "
                      "has revoked this key",
                      revision.name));
    }
    log_key(stores, revision.name, now, true);
    ++outcome.taken;
    set_received(revision, revision.token_hash);
  }

  void take_correction(const Revision& revision) {
    const Measurement& m = *revision.measurement;
    // The measurement belongs to the centre's present history or to one before it.
    const std::int64_t centre = origins.number(m.origin, m.id).value_or(0);
    if (centre == 0) return refuse(fmt::format("a correction is of {} itself", m.origin));
    if (stores.measurements.find_forwarded(centre, m.id)) return;
    if (const std::string_view finding = finding_in(m, revision.text); !finding.empty()) {
      return refuse(fmt::format("the centre's correction {} {}",
                                measurement_id_text(m.id, m.origin), finding));
    }
    const auto of = origins.number(m.corrected_elsewhere->digits, *m.correction_of);
    // It is of a history of this folder that ended before that record.
    if (!of && origins.number(m.corrected_elsewhere->digits, 0) == 0) return;
    const auto target = !of        ? std::nullopt
                        : *of == 0 ? m.correction_of
                                   : stores.measurements.find_forwarded(*of, *m.correction_of);
    if (!target || !stores.measurements.find(*target, [](const auto&) {})) {
      return refuse(fmt::format("the centre's correction {}: its measurement is not stored here",
                                measurement_id_text(m.id, m.origin)));
    }
    MeasurementRow row = to_store(m);
    if (!m.table_revision.empty()) row.table_revision = tables.revision_number(m.table_revision);
    row.id = stores.measurements.last_id() + 1;
    row.origin = centre;
    row.seq = revision.place;
    if (m.id != revision.place) row.number = m.id;
    row.hash = tlog::leaf_hash(revision.text);
    row.corrected_origin = of;
    row.corrected_number = m.correction_of;
    row.correction_of = target;
    auto origin = *stores.origins.find(centre);
    if (!origin.first_row) {
      origin.first_row = row.id;
      stores.origins.set_head(origin);
    }
    stores.measurements.append_forwarded(std::span(&row, 1));
    ++outcome.taken;
  }
};

Result<RevisionIntake::Outcome> RevisionIntake::take(const RevisionPage& page) {
  if (page.revisions.empty()) return Outcome{};
  TRY(prepare(page));
  auto taken = TRY(database_.writer().wait([&](Stores& stores) {
    Job job{
        .stores = stores, .tables = tables_, .origins = origins_, .now = clock_.now().nanoseconds};
    for (const Revision& revision : page.revisions) job.take(revision);
    return job;
  }));
  if (taken.received) tables_.put_in_force(*taken.received);
  for (const auto& [event, detail] : taken.told) tell_once(event, detail);
  return taken.outcome;
}

/// Numbers the table revisions of the centre's corrections, and the centre, each in a commit before
/// the rows, so that every reader of a row knows their names.
Result<void> RevisionIntake::prepare(const RevisionPage& page) {
  std::set<std::string_view> revisions;
  std::set<std::string_view> centres;
  for (const Revision& revision : page.revisions) {
    if (!revision.measurement) continue;
    revisions.insert(revision.measurement->table_revision);
    const std::string_view centre = revision.measurement->origin;
    if (!origins_.number(centre, 0)) centres.insert(centre);
  }
  TRY(tables_.number_revisions(std::move(revisions)));
  if (centres.empty()) return {};
  const auto numbers = TRY(database_.writer().wait([&](Stores& stores) {
    std::map<std::int64_t, std::string_view> added;
    for (const std::string_view digits : centres) {
      const auto found = stores.origins.find(digits);
      added.emplace(found ? found->number : stores.origins.add(digits), digits);
    }
    return added;
  }));
  for (const auto& [number, digits] : numbers) origins_.remember(number, digits);
  return {};
}

void RevisionIntake::tell_once(std::string_view event, const std::string& detail) {
  if (tell_ && told_.insert(detail).second) tell_(event, detail);
}

}  // namespace fitgauge::app
