#include "api/measurements/measurements.hpp"
#include "base/folder.hpp"
#include "formats/dfq/dfq_writer.hpp"
#include "formats/qif/qif.hpp"
#include "plant/kind.hpp"
#include "record/record.hpp"

namespace fitgauge::connections {
namespace {

/// A folder from which others collect files of measurements.
struct FolderOutOptions {
  FollowerOptions follower{.gather = std::chrono::seconds(60), .plans = true};
  std::filesystem::path folder{};
  enum class Format { Csv, Ndjson, Dfq, Qif } format = Format::Csv;
  enum class Split { None, Part, Order } split = Split::None;  ///< a file has only one of these
  aqdef::DfqOptions dfq{};
};

using Format = FolderOutOptions::Format;
using Split = FolderOutOptions::Split;

constexpr std::size_t kLongestKeyInName = 60;

/// Measurements of one file.
struct File {
  std::string key{};
  std::int64_t first = 0;
  std::int64_t last = 0;
  std::string text{};
  std::optional<aqdef::DfqWriter> dfq{};
  std::optional<qif::QifWriter> qif{};
};

std::string_view key_of(const app::Measurement& measurement, Split split) {
  if (split == Split::None) return {};
  const auto& text = split == Split::Part ? measurement.part_id : measurement.order;
  return text.value_or("");
}

/// Returns the key in letters of a file name; the numbers before it keep equal keys apart.
std::string plain(std::string_view key) {
  std::string name(key.substr(0, kLongestKeyInName));
  std::ranges::replace_if(
      name, [](char c) { return !is_ascii_alphanumeric(c) && c != '-' && c != '_'; }, '_');
  return name;
}

/// Returns NAME-FIRST-LAST.csv, with `more` before the ending.
std::string file_name(const FolderOutOptions& options, std::int64_t first, std::int64_t last,
                      std::string_view more) {
  constexpr std::array<std::string_view, 4> kEndings = {".csv", ".ndjson", ".dfq", ".qif"};
  return fmt::format("{}-{:012}-{:012}{}{}", options.follower.name, first, last, more,
                     kEndings.at(static_cast<std::size_t>(options.format)));
}

/// Whether the name is taken by anything but a file with this text.
bool has_other(const Folder& folder, const std::string& name, std::string_view text) {
  if (!folder.look(name)) return false;
  const auto file = folder.read(name);
  const auto there = file && *file ? read_all(**file) : Result<std::string>(Error{});
  return !there || *there != text;
}

/// Writes NAME-FIRST-LAST.csv, with the positions of the measurements in the log; to a temporary
/// file that is renamed when it is complete and on disk. A branch has its digits after the
/// positions, which occur in both histories. Measurements that a DFQ cannot express are
/// dead letters.
class FolderOut final : public Outlet {
 public:
  FolderOut(FolderOutOptions options, const Plant& plant)
      : options_(std::move(options)), plant_(plant) {}

  Delivery deliver(std::span<const Outgoing> measurements, const std::stop_token&) override {
    Delivery delivery;
    std::vector<DeadLetter> refused;
    const auto folder = Folder::open(options_.folder);
    if (!folder) return {.failure = folder.error().message};
    for (const File& file : files_of(measurements, refused)) {
      if (file.text.empty()) continue;  // nothing of it is writable
      if (const auto written = folder->write(name_of(file, *folder), file.text); !written) {
        delivery.failure = written.error().message;
        return delivery;
      }
      ++delivery.files;
      delivery.bytes += file.text.size();
    }
    delivery.refused = std::move(refused);
    delivery.dealt_with = measurements.size();
    return delivery;
  }

 private:
  std::vector<File> files_of(std::span<const Outgoing> measurements,
                             std::vector<DeadLetter>& refused) const {
    std::vector<File> files;
    for (const Outgoing& outgoing : measurements) {
      const app::Measurement& measurement = **outgoing;
      const std::string_view key = key_of(measurement, options_.split);
      auto file = std::ranges::find_if(files, [&](const File& other) { return other.key == key; });
      if (file == files.end()) {
        files.push_back({.key = std::string(key), .first = measurement.row});
        file = std::prev(files.end());
      }
      file->last = measurement.row;
      if (const auto added = add(*file, measurement); !added) {
        refused.push_back(
            {.measurement = app::measurement_id_text(measurement.id, measurement.origin),
             .reason = added.error().message,
             .at = plant_.clock.now()});
      }
    }
    for (File& file : files) {
      if (file.dfq && !file.dfq->is_empty()) file.text = file.dfq->text();
      if (file.qif && !file.qif->is_empty()) file.text = file.qif->text();
    }
    return files;
  }

  /// @errors a DFQ or a QIF cannot express it.
  Result<void> add(File& file, const app::Measurement& measurement) const {
    switch (options_.format) {
      case Format::Csv:
        if (file.text.empty()) file.text = api::measurement_csv_header();
        api::append_measurement_csv(file.text, measurement);
        break;
      case Format::Ndjson:
        app::append_record(file.text, measurement);
        file.text += '\n';
        break;
      case Format::Dfq:
        if (!file.dfq) file.dfq.emplace(options_.dfq);
        return file.dfq->add(measurement);
      case Format::Qif:
        if (!file.qif) file.qif.emplace();
        return file.qif->add(measurement);
    }
    return {};
  }

  /// Returns a name that no file with another content has.
  std::string name_of(const File& file, const Folder& folder) const {
    std::string more = plant_.is_branch ? "-" + plant_.origin : "";
    if (!file.key.empty()) more += "-" + plain(file.key);
    std::string free = file_name(options_, file.first, file.last, more);
    for (int number = 2; has_other(folder, free, file.text); ++number) {
      free = file_name(options_, file.first, file.last, fmt::format("{}-{}", more, number));
    }
    return free;
  }

  const FolderOutOptions options_;
  const Plant& plant_;
};

FolderUse folder_of(const FolderOutOptions& options) {
  return {.folder = options.folder, .writes = {file_name(options, 1, 1, "")}};
}

/// The form of a text that is written in this field of a DFQ.
auto part_text(std::size_t longest, int field) {
  return By{longest, [field](std::string_view text) -> Result<std::string> {
              if (text.empty()) return invalid_field("must be a text");
              TRY(aqdef::check_text(field, text));
              return std::string(text);
            }};
}

template <class V>
void members(V& v, FolderOutOptions& options) {
  v.member("folder", options.folder, path_for(v), "Absolute path on this machine");
  v.optional("time_zone", options.dfq.zone, By{0, sheet::TimeZone::load},
             "Time zone of times in a DFQ (default: UTC)");
  v.optional("format", options.format, Choice{"csv", "ndjson", "dfq", "qif"},
             "Format of the files (default: csv)");
  v.optional("part_number", options.dfq.part_number, part_text(30, aqdef::k::kPartNumber),
             "K1001 of a DFQ (default: -)");
  v.optional("part_description", options.dfq.part_description,
             part_text(80, aqdef::k::kPartDescription), "K1002 of a DFQ (default: -)");
  v.optional("split", options.split, Choice{"none", "part_id", "order"},
             "Field that separates files, one value for each file (default: none)");
  v.optional("every_s", options.follower.gather, Within{1, 86'400},
             "Seconds that new measurements wait for more (default: 60)");
  follower_members(v, options.follower);
}

std::unique_ptr<Outlet> make(const FolderOutOptions& options, const Plant& plant) {
  return std::make_unique<FolderOut>(options, plant);
}

/// Whether a file can be written there.
TestResult test_of(const FolderOutOptions& options, const Plant&, const std::stop_token&) {
  const std::string name = fmt::format(".{}.test", options.follower.name);
  const auto folder = TRY(Folder::open(options.folder));
  TRY(folder.write(name, "fitgauge\n"));
  folder.remove(name);
  return "a file can be written";
}

}  // namespace

Kind folder_out_kind() { return kind_of<FolderOutOptions>("folder_out"); }

}  // namespace fitgauge::connections
