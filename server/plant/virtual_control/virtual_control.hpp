#pragma once

#include "plant/lsv2/link/link_server.hpp"
#include "plant/virtual_control/virtual_disk.hpp"

namespace fitgauge::virtual_control {

/// Differences between controls.
struct ControlModel {
  std::string_view name;  ///< as in `control-model` and R_VR
  std::string_view nc_software;
  bool is_itnc = false;
  bool asks_plc_password = true;  ///< of login FILEPLC

  /// The control's own files; the iTNC 530 has them in the root, in capitals.
  std::string_view mdi_program() const {
    return is_itnc ? "TNC:\\$MDI.H" : "TNC:\\nc_prog\\$mdi.h";
  }
  std::string_view tool_table() const { return is_itnc ? "TNC:\\TOOL.T" : "TNC:\\table\\tool.t"; }
  /// The machine parameter of the dialog language, and its value.
  std::string_view language_parameter() const {
    return is_itnc ? "7230.0" : "CfgDisplayLanguage.ncLanguage";
  }
  std::string_view language() const { return is_itnc ? "0" : "ENGLISH"; }
};

std::span<const ControlModel> control_models();

struct VirtualControlOptions {
  control_link::LinkServerOptions link;
  std::string model;         ///< a name of control_models()
  bool is_writable = false;  ///< false: files and the machine can only be read
  machine::Setup setup;      ///< of the machine it shows
  StartProgram start;
  std::function<void(std::string_view peer, std::string_view why)> sent_away{};
};

/// A file of clients/nc.
struct ExampleProgram {
  std::string_view path;  ///< `8255/8255.h`, below nc_prog
  std::string_view text;
};

std::span<const ExampleProgram> example_programs();

/// The bytes that one transfer uses, of those that all clients' transfers may use together;
/// released with it. Used by one thread.
class ByteShare {
 public:
  /// @param left bytes that nobody uses; outlives it.
  explicit ByteShare(std::size_t& left) : left_(&left) {}
  ByteShare(ByteShare&& other) noexcept
      : left_(other.left_), taken_(std::exchange(other.taken_, 0)) {}
  ByteShare& operator=(ByteShare&& other) noexcept {
    std::swap(left_, other.left_);
    std::swap(taken_, other.taken_);
    return *this;
  }
  ~ByteShare() { *left_ += taken_; }

  /// @returns false if there are not so many left; then nothing is reserved.
  bool take(std::size_t bytes) {
    if (bytes > *left_) return false;
    *left_ -= bytes;
    taken_ += bytes;
    return true;
  }

 private:
  std::size_t* left_;
  std::size_t taken_ = 0;
};

/// State that all clients share.
struct ControlState {
  const ControlModel& model;
  bool is_writable = false;
  VirtualDisk disk;
  MachineView machine;
  std::size_t transfers = std::size_t{24} << 20;    ///< bytes left for those of all clients
  std::map<std::string, std::string> parameters{};  ///< of the machine, by name
};

/// The simulated machine at an LSV-2 port. It adds the files of every control: an MDI program, a
/// tool table and the example programs, unless they are stored.
class VirtualControl {
 public:
  /// @param files, runs must outlive it.
  /// @errors ListenFailed; ConfigInvalid: no such model; those of the storage.
  static Result<std::unique_ptr<VirtualControl>> start(VirtualControlOptions options,
                                                       app::FileService& files,
                                                       app::RunService& runs);
  std::uint16_t port() const { return server_->port(); }

 private:
  explicit VirtualControl(ControlState state) : state_(std::move(state)) {}

  ControlState state_;
  std::unique_ptr<control_link::LinkServer> server_;  // last: it closes every connection
};

/// One client's logins, directory and transfer. A telegram without its login is NoPrivilege; one
/// that changes something is NoWriteAccess at a control that is only read.
class ControlConversation final : public control_link::Conversation {
 public:
  /// @param state outlives it.
  explicit ControlConversation(ControlState& state) : state_(state) {}

  std::optional<control_link::Telegram> answer(const control_link::Telegram& telegram) override;
  std::size_t buffer() const override { return buffer_; }

 private:
  /// A response; none if the protocol has no response.
  using Reply = control_link::ControlResult<std::optional<control_link::Telegram>>;
  /// C_FL, until T_FD.
  struct Receiving {
    interpreter::ControlPath path;
    bool binary;
    std::string bytes;
    ByteShare share;
  };
  /// R_FL and R_DR, until T_FD: the data for each T_OK.
  struct Sending {
    std::string bytes{};  ///< of a file
    std::size_t sent = 0;
    std::vector<DiskEntry> entries{};  ///< of a directory
    bool is_file = false;
    ByteShare share;
  };

  Reply reply(const control_link::Login& login);
  Reply reply(const control_link::Logout& logout);
  Reply reply(const control_link::ReadVersion& request);
  Reply reply(const control_link::ReadParameters&) {
    TRY(needs({"INSPECT"}));
    return encode(control_parameters());
  }
  Reply reply(const control_link::ReadSystemInformation&) {
    return control_link::ControlError::WrongParameter;
  }
  Reply reply(const control_link::SystemCommand& request);
  Reply reply(const control_link::ChangeDirectory& request);
  Reply reply(const control_link::ReadDirectory& request);
  Reply reply(const control_link::ListDirectory& request);
  Reply reply(const control_link::MakeDirectory& request);
  Reply reply(const control_link::DeleteDirectory& request);
  Reply reply(const control_link::ReadFileInformation& request);
  Reply reply(const control_link::DeleteFile& request);
  Reply reply(const control_link::CopyFile& request) {
    return copy(request.source, request.target, false);
  }
  Reply reply(const control_link::RenameFile& request) {
    return copy(request.source, request.target, true);
  }
  Reply reply(const control_link::Upload& request);
  Reply reply(const control_link::Download& request);
  Reply reply(const control_link::ReadRunInformation& request);
  Reply reply(const control_link::ReadMemory& request);
  Reply reply(const control_link::ReadMachineParameter& request);
  Reply reply(const control_link::WriteMachineParameter& request);
  Reply reply(const control_link::LockKeyboard&) {
    TRY(needs_to_write("MONITOR"));
    return encode(control_link::Accepted{});
  }
  Reply reply(const control_link::PressKey& request);
  Reply reply(const control_link::ReadDataPath& request);
  Reply reply(const control_link::FileBlock& block);
  Reply reply(const control_link::EndOfData& end);
  Reply reply(const control_link::Accepted& next);

  Reply next_error(bool first);
  Reply dump_screen(const std::string& path);
  Reply run_program(const std::string& path);
  Reply copy(const std::string& source, const std::string& target, bool moves);
  control_link::DirectoryEntry listed(const DiskEntry& entry) const;

  /// @errors NoPrivilege unless one of them is logged in.
  control_link::ControlResult<void> needs(std::initializer_list<std::string_view> logins) const;
  /// @errors NoPrivilege, NoWriteAccess.
  control_link::ControlResult<void> needs_to_write(std::string_view login) const;

  ControlState& state_;
  std::size_t buffer_ = control_link::kSmallestBuffer;
  bool acknowledges_end_ = false;
  std::set<std::string, std::less<>> logins_;
  std::string directory_ = "TNC:\\";
  std::variant<std::monostate, Receiving, Sending> transfer_;
  std::size_t next_error_ = 0;
};

}  // namespace fitgauge::virtual_control
