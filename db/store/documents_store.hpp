#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::store {

namespace sql {
class Connection;
}

/// The codes are stored: never change one, never use one again.
enum class DocumentKind : std::uint8_t {
  Uncertainty = 1,
  GaugeInUse = 2,
  Setup = 3,
  Plan = 4,
  Connection = 5,
  ConnectionProgress = 6,
  Catalogue = 7,
  Calibration = 8,
};
constexpr DocumentKind last_of(DocumentKind) { return DocumentKind::Calibration; }

struct Document {
  DocumentKind kind = DocumentKind::Uncertainty;
  std::string name{};
  std::string text{};  ///< opaque here
  std::int64_t modified_at_ns = 0;
  std::optional<std::string> caller{};
};

/// Documents by kind and name.
class DocumentsStore {
 public:
  explicit DocumentsStore(sql::Connection& connection);
  ~DocumentsStore();

  bool put(const Document& document);  ///< @returns whether it is new
  bool remove(DocumentKind kind, std::string_view name);
  std::optional<Document> find(DocumentKind kind, std::string_view name) const;
  std::vector<Document> list(DocumentKind kind) const;  ///< by name, with their texts

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
