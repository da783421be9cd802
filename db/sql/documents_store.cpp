#include "db/store/documents_store.hpp"

#include <fmt/format.h>

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {
namespace {

using sql::Rows;

Document read_document(const Rows& rows) {
  require_sound(rows, 5, kDocuments);
  return {.kind = rows.get<DocumentKind>(0),
          .name = rows.get<std::string>(1),
          .text = rows.get<std::string>(2),
          .modified_at_ns = rows.get<std::int64_t>(3),
          .caller = rows.get<std::optional<std::string>>(4)};
}

}  // namespace

struct DocumentsStore::Statements {
  explicit Statements(sql::Connection& c)
      : find(c, fmt::format("SELECT {}, {} FROM documents WHERE kind = ? AND name = ?",
                            kDocuments.columns, kDocuments.is_sound(c))),
        list(c, fmt::format("SELECT {}, {} FROM documents WHERE kind = ? ORDER BY name",
                            kDocuments.columns, kDocuments.is_sound(c))),
        put(c, kDocuments.replace(c)),
        remove(c, "DELETE FROM documents WHERE kind = ? AND name = ? RETURNING 1") {}

  sql::Statement find;
  sql::Statement list;
  sql::Statement put;
  sql::Statement remove;
};

DocumentsStore::DocumentsStore(sql::Connection& connection)
    : statements_(std::make_unique<Statements>(connection)) {}
DocumentsStore::~DocumentsStore() = default;

bool DocumentsStore::put(const Document& document) {
  const bool is_new = !find(document.kind, document.name);
  statements_->put.run(document.kind, document.name, document.text, document.modified_at_ns,
                       document.caller);
  return is_new;
}

bool DocumentsStore::remove(DocumentKind kind, std::string_view name) {
  return statements_->remove.run_counting(kind, name) > 0;
}

std::optional<Document> DocumentsStore::find(DocumentKind kind, std::string_view name) const {
  Rows rows = statements_->find.query(kind, name);
  return rows.next() ? std::optional(read_document(rows)) : std::nullopt;
}

std::vector<Document> DocumentsStore::list(DocumentKind kind) const {
  std::vector<Document> documents;
  for (Rows rows = statements_->list.query(kind); rows.next();) {
    documents.push_back(read_document(rows));
  }
  return documents;
}

}  // namespace fitgauge::store
