#include "plant/folder/folder_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include "api/measurements/measurement_codec.hpp"
#include "api/measurements/measurement_dfq.hpp"
#include "api/measurements/measurement_qif.hpp"
#include "base/text.hpp"
#include "plant/folder/whole_file.hpp"
#include "record/record.hpp"

namespace fitgauge::connections {
namespace {

namespace fs = std::filesystem;
using Format = FolderOutOptions::Format;
using Split = FolderOutOptions::Split;

constexpr std::size_t kLongestKeyInName = 60;

/// Measurements that stand in one file.
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

/// What a name of a file may have; the numbers before it keep two apart that become alike.
std::string plain(std::string_view key) {
  std::string name(key.substr(0, kLongestKeyInName));
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return !is_ascii_alphanumeric(c) && c != '-' && c != '_'; }, '_');
  return name;
}

class FolderOut final : public Outlet {
 public:
  FolderOut(FolderOutOptions options, const Plant& plant)
      : options_(std::move(options)), plant_(plant) {}

  Delivery deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) override;

 private:
  std::vector<File> files_of(std::span<const Outgoing> measurements,
                             std::vector<DeadLetter>& refused) const;
  /// @errors a DFQ or a QIF cannot hold it.
  Result<void> add(File& file, const app::Measurement& measurement) const;
  fs::path path_of(const File& file) const;

  const FolderOutOptions options_;
  const Plant& plant_;
};

Result<void> FolderOut::add(File& file, const app::Measurement& measurement) const {
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
      return api::add_to_dfq(*file.dfq, measurement);
    case Format::Qif:
      if (!file.qif) file.qif.emplace();
      return api::add_to_qif(*file.qif, measurement);
  }
  return {};
}

std::vector<File> FolderOut::files_of(std::span<const Outgoing> measurements,
                                      std::vector<DeadLetter>& refused) const {
  std::vector<File> files;
  for (const Outgoing& outgoing : measurements) {
    const app::Measurement& measurement = **outgoing;
    const std::string_view key = key_of(measurement, options_.split);
    auto file = std::find_if(files.begin(), files.end(),
                             [&](const File& other) { return other.key == key; });
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

fs::path FolderOut::path_of(const File& file) const {
  std::string name = fmt::format("{}-{:012}-{:012}", options_.follower.name, file.first, file.last);
  if (!file.key.empty()) name += "-" + plain(file.key);
  constexpr std::array<std::string_view, 4> kEndings = {".csv", ".ndjson", ".dfq", ".qif"};
  name += kEndings.at(static_cast<std::size_t>(options_.format));
  return options_.folder / name;
}

Delivery FolderOut::deliver(std::span<const Outgoing> measurements, const std::stop_token&) {
  Delivery delivery;
  std::vector<DeadLetter> refused;
  for (const File& file : files_of(measurements, refused)) {
    if (file.text.empty()) continue;  // nothing of it can be written
    const fs::path path = path_of(file);
    if (!write_whole_file(path, file.text)) {
      delivery.failure = fmt::format("cannot write {}: {}", path.string(), std::strerror(errno));
      return delivery;
    }
    ++delivery.files;
    delivery.bytes += file.text.size();
  }
  delivery.refused = std::move(refused);
  delivery.dealt_with = measurements.size();
  return delivery;
}

template <class Word>
Word read_word(std::string_view name, api::FieldReader& fields, Word fallback,
               std::initializer_list<std::pair<std::string_view, Word>> words,
               std::string_view said) {
  const auto text = fields.optional_text(name);
  if (!text) return fallback;
  const auto found = std::find_if(words.begin(), words.end(),
                                  [&](const auto& word) { return word.first == *text; });
  if (found != words.end()) return found->second;
  fields.report(ErrorCode::FieldInvalid, name, std::string(said));
  return fallback;
}

/// A text of a part that stands in a field of a DFQ.
void read_part_text(std::string_view name, int field, api::FieldReader& fields, std::string& into) {
  const auto text = fields.optional_text(name);
  if (!text) return;
  into = *text;
  if (const auto checked = aqdef::check_text(field, into); !checked || into.empty()) {
    fields.report(ErrorCode::FieldInvalid, name,
                  checked ? std::string("a text is wanted") : checked.error().message);
  }
}

void read_dfq_options(api::FieldReader& fields, aqdef::DfqOptions& options) {
  read_part_text("part_number", aqdef::k::kPartNumber, fields, options.part_number);
  read_part_text("part_description", aqdef::k::kPartDescription, fields, options.part_description);
  const auto name = fields.optional_text("time_zone");
  if (!name) return;
  auto zone = sheet::TimeZone::load(*name);
  if (zone) {
    options.zone = *std::move(zone);
  } else {
    fields.report(ErrorCode::FieldInvalid, "time_zone", zone.error().message);
  }
}

}  // namespace

FolderOutOptions read_folder_out(std::string_view name, const FolderPermissions& allowed,
                                 api::FieldReader& fields, api::FieldErrors& errors) {
  FolderOutOptions options;
  options.follower.name = name;
  options.folder = read_path("folder", allowed, fields);
  options.format = read_word("format", fields, Format::Csv,
                             {{"csv", Format::Csv},
                              {"ndjson", Format::Ndjson},
                              {"dfq", Format::Dfq},
                              {"qif", Format::Qif}},
                             "format is csv, ndjson, dfq or qif");
  read_dfq_options(fields, options.dfq);
  options.split =
      read_word("split", fields, Split::None,
                {{"none", Split::None}, {"part_id", Split::Part}, {"order", Split::Order}},
                "split is none, part_id or order");
  read_follower(fields, errors, options.follower);
  options.follower.gather = std::chrono::seconds(fields.integer_or("every_s", 60, 1, 86'400));
  options.follower.plans = true;
  return options;
}

std::unique_ptr<Outlet> make_folder_out(const FolderOutOptions& options, const Plant& plant) {
  return std::make_unique<FolderOut>(options, plant);
}

ConnectionTest test_folder_out(const FolderOutOptions& options) {
  const fs::path path = options.folder / fmt::format(".{}.test", options.follower.name);
  if (!write_whole_file(path, "fitgauge\n")) {
    return {.ok = false,
            .detail = fmt::format("cannot write into {}: {}", options.folder.string(),
                                  std::strerror(errno))};
  }
  std::error_code failure;
  fs::remove(path, failure);
  return {.ok = true, .detail = "a file can be written"};
}

}  // namespace fitgauge::connections
