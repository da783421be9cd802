// A DFQ read from a file: `bench_dfq FILE [rows]`. Prints how many characteristics and values it
// has; with `rows` as CSV of measurements, else as fields alone.

#include <fcntl.h>
#include <unistd.h>

#include "formats/dfq/measurement_csv.hpp"
#include "formats/dfq/reader.hpp"

namespace {

using fitgauge::aqdef::MeasurementCsv;
using fitgauge::aqdef::Reader;
using fitgauge::aqdef::ValueSet;

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "bench_dfq FILE [rows]\n");
    return 2;
  }
  const int file = open(argv[1], O_RDONLY);
  const auto read = [file](std::span<char> into) -> fitgauge::Result<std::size_t> {
    const ssize_t count = ::read(file, into.data(), into.size());
    return count < 0 ? 0 : static_cast<std::size_t>(count);
  };
  std::size_t values = 0;
  std::string said;
  std::size_t characteristics = 0;
  if (argc > 2 && std::string_view(argv[2]) == "rows") {
    fitgauge::aqdef::MeasurementOptions options;
    options.zone = fitgauge::sheet::TimeZone::load("UTC").value();
    options.length_unit = fitgauge::sheet::LengthUnit::Millimetre;
    options.leaves_out_others = true;
    MeasurementCsv csv(read, options);
    std::string rows;
    std::vector<std::uint32_t> lines;
    for (;;) {
      rows.clear();
      lines.clear();
      const auto more = csv.append(rows, lines);
      if (!more) said = more.error().message;
      if (!more || !*more) break;
      values += lines.size();
    }
    if (const auto checked = csv.check(); said.empty() && !checked) said = checked.error().message;
  } else {
    Reader reader(read);
    ValueSet set;
    for (;;) {
      const auto more = reader.next(set);
      if (!more) said = more.error().message;
      if (!more || !*more) break;
      for (const auto& value : set.values) values += set.cell(value, 0).empty() ? 0U : 1U;
    }
    if (const auto checked = reader.check(); said.empty() && !checked) {
      said = checked.error().message;
    }
    characteristics = reader.description().count();
  }
  fmt::print("{} characteristics, {} values{}{}\n", characteristics, values,
             said.empty() ? "" : ": ", said);
  return said.empty() ? 0 : 1;
}
