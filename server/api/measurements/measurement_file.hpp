#pragma once

#include "formats/dfq/dfq_writer.hpp"
#include "formats/qif/qif.hpp"

namespace fitgauge::api {

/// Measurements as a file that is made whole before its first byte is sent. One thread at a time.
class MeasurementFile {
 public:
  /// Maximum number of rows in a file, because it is made in memory.
  static constexpr std::size_t kMostRows = 100'000;
  /// Maximum number of bytes of their records, which bounds the file.
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

  MeasurementFile& operator=(MeasurementFile&&) = delete;  // neither copied nor moved
  virtual ~MeasurementFile() = default;

  /// @errors QueryInvalid: the format cannot express it.
  virtual Result<void> add(const app::Measurement& measurement) = 0;
  /// The whole file. @errors StorageUnavailable
  virtual Result<std::string> finish() = 0;
};

/// Makes a DFQ of Q-DAS. An empty list is an error: a DFQ needs a characteristic.
std::unique_ptr<MeasurementFile> make_dfq_file(aqdef::DfqOptions options);

/// Makes a QIF 3.0 file; an empty list is an error here too.
std::unique_ptr<MeasurementFile> make_qif_file();

/// XLSX, with the columns of the CSV. @param zone of its times; none: UTC
/// @errors StorageUnavailable
Result<std::unique_ptr<MeasurementFile>> make_xlsx_file(std::optional<sheet::TimeZone> zone);

/// Adds a measurement. @errors those of aqdef::DfqWriter::add; FieldInvalid: it is simulated.
Result<void> add_to_dfq(aqdef::DfqWriter& writer, const app::Measurement& measurement);

/// Adds a measurement. @errors those of qif::QifWriter::add; FieldInvalid: it is simulated.
Result<void> add_to_qif(qif::QifWriter& writer, const app::Measurement& measurement);

}  // namespace fitgauge::api
