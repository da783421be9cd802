#pragma once

#include "nc/machine/machine_setup.hpp"
#include "nc/program/control_disk.hpp"
#include "plant/lsv2/link/messages.hpp"
#include "plant/lsv2/link/payload.hpp"
#include "service/files/file_service.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::virtual_control {

inline constexpr std::string_view kRoot = "TNC:\\";

/// A file as a client names it: absolute, or relative to its directory. `/` separates as `\` does.
/// @param directory ends with `\`
/// @errors BadFileName: another drive, a path out of `TNC:\`, no file name.
control_link::ControlResult<interpreter::ControlPath> file_path(std::string_view text,
                                                                std::string_view directory);

/// A directory with its last `\`; the disk decides if it exists. @errors BadFileName.
control_link::ControlResult<std::string> directory_path(std::string_view text,
                                                        std::string_view directory);

/// The parent of a directory; of the root the root.
std::string_view parent_of(std::string_view directory);

/// A file or a directory as the control lists it.
struct DiskEntry {
  std::string name;
  bool is_directory = false;
  std::int64_t size = 0;
  Timestamp modified_at{};
};

/// The control's disk: the files of `/v1/files`, and over them the files of the newest run.
/// Directories are those of files, those of every control (`nc_prog`, `table`), and those that
/// clients have made, which exist until the service ends. Used by one thread, which waits for the
/// storage.
class VirtualDisk {
 public:
  using Path = interpreter::ControlPath;
  template <class T>
  using Answer = control_link::ControlResult<T>;

  VirtualDisk(app::FileService& files, app::RunService& runs) : files_(files), runs_(runs) {}

  bool has_directory(std::string_view directory);
  /// Lists entries by name, directories first. @errors NoDirectory.
  Answer<std::vector<DiskEntry>> list(std::string_view directory);
  /// @errors NoDirectory: its parent; FileExists; NoSpace.
  Answer<void> make_directory(std::string_view directory);
  /// @errors NoDirectory, DirectoryNotEmpty, InUse: one of every control.
  Answer<void> remove_directory(std::string_view directory);

  /// @errors NoFile.
  Answer<DiskEntry> find(const Path& path);
  /// @errors NoFile.
  Answer<std::shared_ptr<const std::string>> read(const Path& path);
  /// Writes a new file or replaces one. @errors NoDirectory, NoSpace.
  Answer<void> write(const Path& path, std::string_view bytes);
  /// @errors NoFile.
  Answer<void> remove(const Path& path);
  /// @errors NoFile, NoDirectory, FileExists, NoSpace.
  Answer<void> copy(const Path& source, const Path& target);
  /// @errors as copy.
  Answer<void> rename(const Path& source, const Path& target) {
    TRY(copy(source, target));
    return remove(source);
  }

 private:
  using RunFiles = std::shared_ptr<const std::vector<interpreter::WrittenFile>>;
  /// Files of the newest run that no client has replaced or removed.
  std::map<std::string, std::pair<const interpreter::WrittenFile*, Timestamp>> run_files();
  /// Every file whose path begins so, by key.
  Answer<std::map<std::string, DiskEntry>> files_below(std::string_view prefix);
  void keep_directory(std::string_view directory);
  /// Uses the stored file from now on, not the run's file.
  void hide(const Path& path) {
    if (run_files().contains(path.key())) hidden_.insert(path.key());
  }

  app::FileService& files_;
  app::RunService& runs_;
  std::map<std::string, std::string> made_;  ///< by key: as spelled
  std::size_t made_bytes_ = 0;
  RunFiles newest_files_;  ///< that run_files points into
  std::int64_t run_ = 0;   ///< whose files `hidden_` names
  std::set<std::string> hidden_;
};

/// Starts a stored program on the control's machine, and waits until it is queued.
/// @errors as POST /v1/runs.
using StartProgram =
    std::function<Result<std::shared_ptr<app::ActiveRun>>(const interpreter::ControlPath&)>;

/// The machine for DNC telegrams: the machine of the newest run, running or finished; before the
/// first run, at rest as in its setup. Used by one thread.
class MachineView {
 public:
  MachineView(app::RunService& runs, machine::Setup setup, StartProgram start)
      : runs_(runs), setup_(std::move(setup)), start_(std::move(start)) {}

  control_link::Axes axes();
  control_link::Mode mode() {
    newest();
    return mode_;
  }
  control_link::ProgramState state();
  control_link::ProgramStack program();
  control_link::SpindleTool tool();
  std::vector<interpreter::RunMessage> errors() { return look().errors; }

  /// A key counts after a program that has begun before it.
  void set_mode(control_link::Mode mode) {
    newest();
    mode_ = mode;
  }
  /// @errors WrongMode while a program runs; NoFile; BadFormat: it has errors; InUse: too many
  /// wait.
  control_link::ControlResult<std::shared_ptr<app::ActiveRun>> start(
      const interpreter::ControlPath& program);
  /// Ends what runs, soon.
  void stop() {
    if (const auto run = newest(); run != nullptr) runs_.cancel(run);
  }

 private:
  std::shared_ptr<app::ActiveRun> newest();
  app::LiveState look();

  app::RunService& runs_;
  const machine::Setup setup_;
  const StartProgram start_;
  control_link::Mode mode_ = control_link::Mode::Manual;
  std::int64_t seen_run_ = 0;
  std::shared_ptr<app::ActiveRun> started_;  ///< the last run that a client has started
};

/// The PLC of a machine without one: every cell is 0 and every string empty.
control_link::Parameters control_parameters();

/// `count` bytes from `address`. @errors BadAddress.
control_link::ControlResult<control_link::Memory> read_memory(std::uint32_t address,
                                                              std::uint8_t count);

/// A value by its data path, `\PLC\memory\W\2`: the type of the path, and 0.
/// @errors WrongParameter: a path of another tree.
control_link::ControlResult<control_link::DataValue> read_data_path(std::string_view path);

/// A bitmap (BMP) of 640 by 480 in the colour of the program's state, because the simulation has no
/// screen: green runs, red failed, grey else.
std::string screen_dump(control_link::ProgramState state);

}  // namespace fitgauge::virtual_control
