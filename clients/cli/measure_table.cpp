#include "cli/measure_table.hpp"

#include <fmt/format.h>

#include "formats/sheet/shop_csv.hpp"

namespace fitgauge::cli {
namespace {

/// `name=text`. @errors Usage
Outcome<sheet::Words> read_words(std::string_view option, const std::vector<std::string>& texts) {
  sheet::Words words;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    if (equals == 0 || equals == std::string::npos) {
      return Failure{ExitCode::Usage, fmt::format("{} takes NAME=TEXT, not '{}'", option, text)};
    }
    words.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return words;
}

}  // namespace

bool is_converted(const MeasureOptions& options) {
  return !options.encoding.empty() || !options.columns.empty() || !options.constants.empty() ||
         !options.time_zone.empty() || options.leave_out_others;
}

Outcome<sheet::ShopCsvOptions> table_options(const MeasureOptions& options) {
  sheet::ShopCsvOptions table{.leaves_out_others = options.leave_out_others};
  auto columns = read_words("--map", options.columns);
  if (!columns) return columns.error();
  table.columns = *std::move(columns);
  auto constants = read_words("--set", options.constants);
  if (!constants) return constants.error();
  table.constants = *std::move(constants);
  if (!options.encoding.empty()) {
    const auto encoding = sheet::encoding_from_word(options.encoding);
    if (!encoding) {
      return Failure{ExitCode::Usage, "--encoding is auto, utf-8, utf-16 or windows-1252"};
    }
    table.encoding = *encoding;
  }
  if (!options.time_zone.empty()) {
    auto zone = sheet::TimeZone::load(options.time_zone);
    if (!zone) return Failure{ExitCode::Usage, zone.error().message};
    table.zone = *std::move(zone);
  }
  return table;
}

}  // namespace fitgauge::cli
