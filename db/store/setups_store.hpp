#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::store {

namespace sqlite {
class Connection;
}

struct Setup {
  std::string name{};
  std::string text{};  ///< opaque here
  std::int64_t modified_at_ns = 0;
  std::optional<std::string> caller{};
};

/// Named machine setups.
class SetupsStore {
 public:
  explicit SetupsStore(sqlite::Connection& connection);
  ~SetupsStore();

  bool put(const Setup& setup);  ///< @returns whether it is new
  bool remove(std::string_view name);
  std::optional<Setup> find(std::string_view name) const;
  std::vector<Setup> list() const;  ///< by name, with their texts

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
