#include "tables/iso286/nominal_size.hpp"

namespace fitgauge::iso286 {
namespace {

Error out_of_range(std::string_view size) {
  return {ErrorCode::SizeOutOfRange,
          "nominal size " + std::string(size) + " mm must be above 0 and at most 3150 mm"};
}

}  // namespace

Result<NominalSize> NominalSize::make(Length size) {
  if (size <= Length() || size > kLargestNominalSize) return out_of_range(format_mm(size));
  return NominalSize(size);
}

Result<NominalSize> NominalSize::parse_mm(std::string_view text, LengthSyntax syntax) {
  const auto size = parse_length_mm(text, syntax);
  if (!size && size.error().code == ErrorCode::LengthOutOfRange) return out_of_range(text);
  if (!size) return size.error();
  return make(*size);
}

std::string format_range(const NominalSizeRange& range) {
  return "over " + format_mm(range.over) + " up to and including " + format_mm(range.up_to) + " mm";
}

}  // namespace fitgauge::iso286
