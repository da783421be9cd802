#pragma once

#include "db/store/documents_store.hpp"
#include "nc/program/control_disk.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

inline constexpr std::string_view kDrive = "TNC:\\";
inline constexpr std::string_view kFiles = "/v1/files/";

/// Path of a file on the control's disk: `TNC:\nc_prog\8255.h`, or as under /v1/files,
/// `nc_prog/8255.h`, with or without this prefix. @errors those of ControlPath::parse.
Result<interpreter::ControlPath> parse_file_path(std::string_view text);

/// The uploaded files as a control's disk. Thread-safe. Every call waits for the database, so it is
/// only for worker threads. Throws if the storage fails.
class StoredDisk final : public interpreter::ControlDisk {
 public:
  /// @param database outlives the disk.
  explicit StoredDisk(Database& database) : database_(database) {}

  std::optional<interpreter::ControlFile> find(const interpreter::ControlPath& path) const override;
  std::optional<std::string> revision(const interpreter::ControlPath& path) const override;
  bool has_directory(std::string_view directory) const override;

 private:
  Database& database_;
};

/// The files of the control's disk. Nothing here blocks; `done` comes exactly once, on a storage
/// thread or, when refused at once, on the caller's. Thread-safe.
class FileService {
 public:
  FileService(Database& database, const Clock& clock) : database_(database), clock_(clock) {}

  /// Decides from the current bytes, if there is a file, whether the change is allowed; called in
  /// the transaction of the change. An empty function allows every change.
  using Precondition = std::function<bool(std::optional<std::string_view> bytes)>;

  /// Returns whether the file is new. @param bytes stays alive until `done`.
  /// @errors PreconditionFailed, StorageUnavailable, StorageBusy.
  void write(interpreter::ControlPath path, std::string_view bytes,
             std::optional<std::string> caller, Precondition precondition, Done<bool> done);

  /// @errors FileUnknown, StorageUnavailable.
  void read(interpreter::ControlPath path, Done<store::FileContent> done);

  /// @param users that are not documents: RunService::queued().
  /// @errors FileUnknown, DocumentInUse with the names, PreconditionFailed, StorageUnavailable,
  ///   StorageBusy.
  void remove(interpreter::ControlPath path, std::optional<std::string> caller,
              Precondition precondition, std::vector<std::string> users, Done<bool> done);

  /// Every file whose path begins so, by path.
  void list(std::string prefix, Done<std::vector<store::FileEntry>> done);

 private:
  Database& database_;
  const Clock& clock_;
};

}  // namespace fitgauge::app
