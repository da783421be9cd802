namespace fitgauge {
namespace {

struct Row {
  std::string_view id;
  std::string_view title;
};

constexpr Row kRows[] = {
#define FITGAUGE_ERROR(name, id, title, status) {id, title},
#include "base/error_codes.inc"
#undef FITGAUGE_ERROR
};

}  // namespace

std::string_view id(ErrorCode code) { return kRows[static_cast<std::size_t>(code)].id; }

std::string_view title(ErrorCode code) { return kRows[static_cast<std::size_t>(code)].title; }

void throw_bad_result(const Error& error) {
  throw std::logic_error(std::string(id(error.code)) + ": " + error.message);
}

}  // namespace fitgauge
