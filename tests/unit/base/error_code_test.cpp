#include <doctest/doctest.h>

using namespace fitgauge;

TEST_CASE("every error code has a stable id of its own and a title") {
  std::set<std::string> ids;
  std::size_t count = 0;
#define FITGAUGE_ERROR(name, text_id, text_title, status)               \
  CHECK(id(ErrorCode::name) == (text_id));                              \
  CHECK_FALSE(title(ErrorCode::name).empty());                          \
  CHECK(std::string_view(text_id).find('.') != std::string_view::npos); \
  ids.emplace(text_id);                                                 \
  ++count;
#include "base/error_codes.inc"
#undef FITGAUGE_ERROR
  CHECK(ids.size() == count);
}

TEST_CASE("reading a failed result is a bug and says which") {
  const Result<int> failed = Error{ErrorCode::ClassUnknown, "no class I7"};
  CHECK_THROWS_WITH(static_cast<void>(failed.value()), "class.unknown: no class I7");
}
