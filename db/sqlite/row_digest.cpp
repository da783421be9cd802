#include "db/sqlite/row_digest.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>

#include "db/sqlite/failure.hpp"
#include "db/store/canonical_digest.hpp"

namespace fitgauge::store::sqlite {
namespace {

void add_value(CanonicalDigest& digest, sqlite3_value* value) {
  const auto size = [&] { return static_cast<std::size_t>(sqlite3_value_bytes(value)); };
  switch (sqlite3_value_type(value)) {
    case SQLITE_NULL: digest.add(std::optional<std::int64_t>()); break;
    case SQLITE_INTEGER: digest.add(sqlite3_value_int64(value)); break;
    default: {
      const auto* bytes = static_cast<const char*>(sqlite3_value_blob(value));
      digest.add(std::string_view(bytes == nullptr ? "" : bytes, size()));
    }
  }
}

void row_digest(sqlite3_context* context, int count, sqlite3_value** values) noexcept {
  try {
    auto& digest = *static_cast<CanonicalDigest*>(sqlite3_user_data(context));
    std::for_each(values, values + count, [&](sqlite3_value* value) { add_value(digest, value); });
    const Digest result = digest.finish();
    sqlite3_result_blob(context, result.data(), static_cast<int>(result.size()), SQLITE_TRANSIENT);
  } catch (const std::exception&) {
    sqlite3_result_error_nomem(context);
  }
}

}  // namespace

void add_row_digest(sqlite3* handle) {
  auto digest = std::make_unique<CanonicalDigest>();
  const auto destroy = [](void* made) { delete static_cast<CanonicalDigest*>(made); };
  // SQLite destroys it even when this fails.
  require_ok(handle,
             sqlite3_create_function_v2(handle, "row_digest", -1,
                                        SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS,
                                        digest.release(), row_digest, nullptr, nullptr, destroy),
             "storage");
}

}  // namespace fitgauge::store::sqlite
