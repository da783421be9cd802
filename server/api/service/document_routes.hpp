#pragma once

#include "api/resources.hpp"
#include "base/json/json_writer.hpp"
#include "service/documents/document_service.hpp"

// All documents (texts with a name) have the same four routes, tags and preconditions.

namespace fitgauge::api {

/// A body that was read.
struct CheckedDocument {
  std::string text{};                        ///< the stored text, which a GET returns
  std::string answer{};                      ///< to its PUT; empty: nothing
  std::optional<std::string> uncertainty{};  ///< a budget that must be there
  std::optional<std::string> gauge{};        ///< reference of a gauge in use
  std::optional<std::string> before{};       ///< the text it was made from; another refuses it
};

/// Writes the entry of a document in a list, without its time.
/// @errors StorageCorrupt.
using DescribeDocument = Result<void> (*)(JsonWriter& json, const app::NamedDocument& document);
Result<void> describe_by_name(JsonWriter& json, const app::NamedDocument& document);

/// Differences between the kinds.
struct KindOfDocument {
  app::DocumentKind kind{};
  std::string_view path{};              ///< of the list
  std::string_view parameter = "name";  ///< of a document's path
  std::string_view one{};               ///< as a sentence names it
  std::string_view contents{};          ///< its content
  std::string_view many{};
  std::string_view member{};              ///< of the list's answer
  std::string_view operation{};           ///< after get, put, delete
  std::string_view operations{};          ///< after list
  std::string_view schema = operation;    ///< of the stored document
  std::string_view body_schema = schema;  ///< of the request
  std::string_view list_schema = operations;
  std::string_view answered{};  ///< schema of the response to a PUT; empty: none
  std::size_t longest_name = 200;
  bool names_with_slashes = true;
  DescribeDocument describe = describe_by_name;
  bool is_figure = false;  ///< its check computes, which may be slow
  /// Runs on a thread that may block. @errors those of the body.
  using Check = Result<CheckedDocument> (*)(const Services& services, const std::string& name,
                                            std::string_view body);
  Check check{};
  // A second form of a body: its media type, its most bytes and its check, which computes.
  std::string_view other_type{};
  std::size_t longest_other = 0;
  Result<CheckedDocument> (*check_other)(const Services& services, const std::string& name,
                                         const FileText& body) = nullptr;
  /// Runs after a change was stored and before the response; null: nothing to do.
  void (*changed)(const Services& services, std::function<void(Result<void>)> done) = nullptr;
};

/// Names the member `uncertainty` in the refusal of a write whose budget does not exist.
Error at_budget(const Error& error);

/// The schema of a list of names and times.
/// @param more fields that the kind's `describe` writes
NamedSchema names_schema(std::string name, std::string_view member,
                         const schema::Fields& more = {});

/// @param kind is static.
void add_document_routes(Routes& add, const KindOfDocument& kind);

}  // namespace fitgauge::api
