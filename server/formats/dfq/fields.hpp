#pragma once

#include "base/result.hpp"

namespace fitgauge::aqdef {

/// Code of file errors: only their text is used, never a response over HTTP.
inline constexpr ErrorCode kMalformed = ErrorCode::CsvMalformed;

/// The subject of a field of the format.
enum class Level : std::uint8_t { File, Value, Part, Characteristic, Catalogue, Group, Other };

enum class FieldType : std::uint8_t { Text, Integer, Number, Time, List };

/// A field as the tables of the format have it.
struct FieldInfo {
  int number = 0;
  FieldType type = FieldType::Text;
  int longest = 0;  ///< characters; 0: the format names no bound
  std::string_view name;
};

/// Returns the level of a number: K0001, K1xxx, K2xxx and so on.
Level level_of(int number);

/// Returns a field that is read or written here; null for others, which are stored unchanged.
const FieldInfo* field_info(int number);

// Numbers of fields that measurements are made of.
namespace k {
inline constexpr int kValue = 1;
inline constexpr int kAttribute = 2;
inline constexpr int kTime = 4;
inline constexpr int kEvents = 5;
inline constexpr int kBatch = 6;
inline constexpr int kCavity = 7;
inline constexpr int kOperator = 8;
inline constexpr int kText = 9;
inline constexpr int kMachine = 10;
inline constexpr int kProcess = 11;
inline constexpr int kGauge = 12;
inline constexpr int kPartIdent = 14;
inline constexpr int kSubgroupSize = 20;
inline constexpr int kOrder = 53;
inline constexpr int kGuid = 97;
inline constexpr int kCount = 100;
inline constexpr int kPartNumber = 1001;
inline constexpr int kPartDescription = 1002;
inline constexpr int kContract = 1053;
inline constexpr int kPartMachineNumber = 1081;
inline constexpr int kPartMachine = 1082;
inline constexpr int kOperation = 1086;
inline constexpr int kArea = 1100;
inline constexpr int kPlant = 1303;
inline constexpr int kNumber = 2001;
inline constexpr int kDescription = 2002;
inline constexpr int kType = 2004;
inline constexpr int kDecimals = 2022;
inline constexpr int kNominal = 2101;
inline constexpr int kToleranceClass = 2103;
inline constexpr int kToleranceGrade = 2104;
inline constexpr int kLowerLimit = 2110;
inline constexpr int kUpperLimit = 2111;
inline constexpr int kLowerAllowance = 2112;
inline constexpr int kUpperAllowance = 2113;
inline constexpr int kLowerLimitType = 2120;
inline constexpr int kUpperLimitType = 2121;
inline constexpr int kUnit = 2142;
inline constexpr int kUserName = 2800;
inline constexpr int kUserType = 2801;
inline constexpr int kUserText = 2802;
inline constexpr int kMachineNumber = 4062;
inline constexpr int kMachineName = 4063;
inline constexpr int kGaugeNumber = 4072;
inline constexpr int kGaugeName = 4073;
inline constexpr int kOperatorName = 4092;
inline constexpr int kOperatorFirstName = 4093;
}  // namespace k

/// A field of a value or its part without a field in measurements.
struct CarriedField {
  int number = 0;
  std::string text;

  friend bool operator==(const CarriedField&, const CarriedField&) = default;
};

/// A comment with the fields that travel in it: `free text |K0097 {…}|K1001 4711|`. A bar in a
/// field is doubled.
struct Comment {
  std::string text{};
  std::vector<CarriedField> fields{};
};

std::string format_comment(const Comment& comment);
/// Parses a comment; other forms are text.
Comment parse_comment(std::string_view comment);

}  // namespace fitgauge::aqdef
