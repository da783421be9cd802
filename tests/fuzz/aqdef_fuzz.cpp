// Bytes as a DFQ: read as fields and as measurements. What is read comes out of the writer, and
// what the writer made is read with the same values and written with the same bytes.

#include "formats/dfq/dfq_writer.hpp"
#include "formats/dfq/measurement_csv.hpp"
#include "target.hpp"

using namespace fitgauge;
using namespace fitgauge::aqdef;

namespace {

/// Every value that is a length, with the fields of its own, as a measurement of 25 H7.
std::string rewritten(std::string_view text) {
  DfqWriter writer({});
  Reader reader(read_text(text));
  ValueSet set;
  for (;;) {
    const auto more = reader.next(set);
    if (!more || !*more) break;
    for (const Value& value : set.values) {
      const auto measured = sheet::parse_length(set.cell(value, 0), sheet::LengthUnit::Millimetre);
      if (!measured || set.cell(value, 1) == "256") continue;
      const Characteristic& characteristic =
          *reader.description().characteristic(value.characteristic);
      const auto part = reader.description().decoded(set.field(value, k::kPartIdent));
      const auto guid = reader.description().decoded(set.field(value, k::kGuid));
      if (!part || !guid) continue;
      const Comment comment{.text = {},
                            .fields = guid->empty() ? std::vector<CarriedField>()
                                                    : std::vector<CarriedField>{{k::kGuid, *guid}}};
      const std::string carried = format_comment(comment);
      app::Measurement out;
      out.origin = "5f0c9a3e77d21b40";
      out.id = 1;
      out.measured = *measured;
      out.nominal_size = Length::millimetres(25);
      out.deviations = {.upper = Length::nanometres(21'000), .lower = {}};
      out.class_name = "H7";
      out.part_id = *part;
      out.characteristic = reader.description().text(characteristic, k::kDescription);
      out.comment = carried;
      writer.add(out).has_value();
    }
  }
  return writer.is_empty() ? std::string() : writer.text();
}

}  // namespace

void take(std::string_view text) {
  static const auto zone = sheet::TimeZone::load("Europe/Berlin");
  MeasurementOptions options;
  options.constants = {{"feature", "hole"}};
  if (zone) options.zone = *zone;
  options.length_unit = sheet::LengthUnit::Millimetre;
  options.leaves_out_others = true;
  MeasurementCsv csv(read_text(text), options);
  std::string rows;
  std::vector<std::uint32_t> lines;
  for (;;) {
    const auto more = csv.append(rows, lines);
    if (!more || !*more) break;
  }
  require(static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n')) == lines.size());
  const std::string once = rewritten(text);
  require(rewritten(once) == once);
}
