#pragma once

#include "base/clock.hpp"
#include "base/json/json_value.hpp"
#include "db/store/documents_store.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

using store::DocumentKind;

/// Returns the name of a gauge's calibration from a time on, and the gauge in such a name.
std::string calibration_name(std::string_view gauge, Timestamp from);
std::string_view gauge_of_calibration(std::string_view name);

/// Adds the documents of a kind, as `plan '4711'`, of which the body, a characteristic, a feature
/// or fixture of the workpiece, or `set` of a folder names something. Used inside a job.
void add_users(std::vector<std::string>& users, const Stores& stores, DocumentKind kind,
               const std::function<bool(const JsonValue&)>& names_it);
/// The state does not allow the change that If-Match or If-None-Match asked for.
Error precondition_failed(std::string_view what, bool exists);
/// @errors DocumentInUse, if there are users.
Result<void> check_unused(std::string_view what, const std::vector<std::string>& users);

/// A document whose text is JSON, checked when it was stored.
using NamedDocument = store::Document;

/// Uncertainty budgets, gauges in use, their studies, machine setups, plans, connections and
/// catalogues. Functions do not block unless documented; `done` is called exactly once, on a
/// storage thread or, if refused at once, on the caller's. Thread-safe. An unknown name is
/// UncertaintyUnknown, GaugeUnknown, StudyUnknown, SetupUnknown, PlanUnknown, ConnectionUnknown or
/// CatalogueUnknown.
class DocumentService {
 public:
  /// Decides from the current text, if there is a document, whether the change is allowed; called
  /// in the transaction of the change. An empty function allows every change.
  using Precondition = std::function<bool(std::optional<std::string_view> text)>;

  /// The new text and its precondition.
  struct Change {
    DocumentKind kind = DocumentKind::Uncertainty;
    std::string name{};
    std::string text{};
    std::optional<std::string> caller{};
    std::optional<std::string> uncertainty{};  ///< a budget that must be there
    std::optional<std::string> gauge{};        ///< reference of a gauge in use
    Precondition precondition{};
  };

  /// @param has_centre whether setups, plans and catalogues of a centre can only be changed there.
  DocumentService(Database& database, const Clock& clock, bool has_centre = false)
      : database_(database), clock_(clock), has_centre_(has_centre) {}

  /// Returns whether the name is new. @errors UncertaintyUnknown: of `uncertainty`; GaugeUnknown;
  /// PreconditionFailed, Forbidden (the centre's), StorageUnavailable, StorageBusy.
  void write(Change change, Done<bool> done);
  /// @errors those of an unknown name, StorageUnavailable.
  void read(DocumentKind kind, std::string name, Done<NamedDocument> done);
  /// @param users that are not documents: RunService::queued().
  /// @errors as read; DocumentInUse (with the names of those that name it) and then
  ///   PreconditionFailed, as RFC 9110, 13.2.1 has it; Forbidden (the centre's), StorageBusy.
  void remove(DocumentKind kind, std::string name, Precondition precondition,
              std::optional<std::string> caller, std::vector<std::string> users, Done<bool> done);
  void list(DocumentKind kind, Done<std::vector<NamedDocument>> done);  ///< by name
  /// Lists several kinds, in one state of the storage. With `has_past` also the earlier texts of
  /// gauges in use: `modified_at` is the time of the last change.
  void list_each(std::vector<DocumentKind> kinds, bool has_past,
                 Done<std::vector<std::vector<NamedDocument>>> done);

  // Variants of the functions above for threads that may wait.
  Result<NamedDocument> wait_for(DocumentKind kind, const std::string& name);
  Result<std::vector<NamedDocument>> wait_for_list(DocumentKind kind);
  Result<bool> write_and_wait(Change change);
  Result<bool> remove_and_wait(DocumentKind kind, const std::string& name,
                               std::optional<std::string> caller = {});

 private:
  Database& database_;
  const Clock& clock_;
  const bool has_centre_;
};

}  // namespace fitgauge::app
