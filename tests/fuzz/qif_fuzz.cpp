// Bytes as a QIF document: read as measurements, in one piece and byte by byte with the same rows.
// What the writer makes of as many values is read with these values.

#include "../support/qif_text.hpp"
#include "target.hpp"

using namespace fitgauge;
using namespace fitgauge::qif;

namespace {

struct Said {
  QifText text{};
  std::string error{};
};

Said said(const Read& first, const Read& again) {
  static const auto zone = sheet::TimeZone::load("Europe/Berlin");
  Said said;
  QifOptions options;
  options.constants = {{"feature", "hole"}};
  if (zone) options.zone = *zone;
  options.length_unit = sheet::LengthUnit::Millimetre;
  options.leaves_out_others = true;
  auto rows = QifRows::open(first, again, options);
  if (!rows) return {.error = rows.error().message};
  for (;;) {
    const auto more = rows->append(said.text.csv, said.text.lines);
    if (!more) said.error = more.error().message;
    if (!more || !*more) return said;
  }
}

/// A text that comes a byte at a time.
Read byte_by_byte(std::string_view text) {
  return [text](std::span<char> into) mutable -> Result<std::size_t> {
    const std::size_t count = text.copy(into.data(), std::min<std::size_t>(into.size(), 1));
    text.remove_prefix(count);
    return count;
  };
}

/// The bytes as texts and values of a document of our own.
void write_and_read(std::string_view bytes) {
  QifWriter writer;
  std::size_t added = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 16) {
    const std::string_view piece = bytes.substr(at, 16);
    app::Measurement value;
    value.origin = "5f0c9a3e77d21b40";
    value.id = static_cast<std::int64_t>(at);
    value.nominal_size = Length::millimetres(25);
    value.measured = value.nominal_size + Length::nanometres(static_cast<unsigned char>(piece[0]));
    value.deviations = {.upper = Length::nanometres(21'000), .lower = {}};
    if (piece.size() % 2 == 0) value.class_name = "H7";
    value.part_id = piece;
    value.characteristic = piece.substr(piece.size() / 2);
    // The service has texts of UTF-8 alone.
    const bool is_ascii = std::all_of(piece.begin(), piece.end(), [](char c) { return c >= 0; });
    if (is_ascii && writer.add(value)) ++added;
  }
  if (added == 0) return;
  const auto read = read_qif(writer.text(), {});
  require(read.has_value());
  require(static_cast<std::size_t>(std::count(read->csv.begin(), read->csv.end(), '\n')) ==
          read->lines.size() + 1);
  require(read->lines.size() >= added);
}

}  // namespace

void take(std::string_view text) {
  const Said whole = said(read_text(text), read_text(text));
  require(static_cast<std::size_t>(std::count(whole.text.csv.begin(), whole.text.csv.end(),
                                              '\n')) == whole.text.lines.size());
  const Said pieces = said(byte_by_byte(text), byte_by_byte(text));
  require(whole.text.csv == pieces.text.csv && whole.text.lines == pieces.text.lines);
  require(whole.error.empty() == pieces.error.empty());
  write_and_read(text);
}
