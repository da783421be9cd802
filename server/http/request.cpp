#include "http/request.hpp"

#include "http/engine/request_head.hpp"
#include "http/field_list.hpp"
#include "http/route.hpp"

namespace fitgauge::http {
namespace {

constexpr std::array<std::string_view, 7> kNames{"GET",    "HEAD",  "POST",   "PUT",
                                                 "DELETE", "PATCH", "OPTIONS"};

}  // namespace

std::string_view name(Method method) {
  const auto index = static_cast<std::size_t>(method);
  return index < kNames.size() ? kNames[index] : std::string_view{};
}

Method method_named(std::string_view name) {
  return enum_of<Method>(name, kNames).value_or(Method::Other);
}

std::optional<std::string_view> Request::header(std::string_view name) const {
  return head_->find(name);
}

std::optional<std::string> Request::header_list(std::string_view name) const {
  return head_->find_list(name);
}

const std::optional<ArgumentValue>& Request::argument(std::string_view name) const {
  for (std::size_t i = 0; i < arguments_.size(); ++i) {
    if (route_->parameters[i].name == name) return arguments_[i];
  }
  throw std::logic_error(fmt::format("the route declares no parameter {}", name));
}

template <class T>
std::optional<T> Request::argument_as(std::string_view name) const {
  const std::optional<ArgumentValue>& value = argument(name);
  if (!value) return std::nullopt;
  if (const T* typed = std::get_if<T>(&*value)) return *typed;
  throw std::logic_error(fmt::format("parameter {} is declared as another type", name));
}

std::optional<std::string_view> Request::text(std::string_view name) const {
  return argument_as<std::string_view>(name);
}
std::optional<std::int64_t> Request::integer(std::string_view name) const {
  return argument_as<std::int64_t>(name);
}
std::optional<Length> Request::length(std::string_view name) const {
  return argument_as<Length>(name);
}
std::optional<Timestamp> Request::time(std::string_view name) const {
  return argument_as<Timestamp>(name);
}

bool Request::is_forwarded() const { return head_->is_forwarded; }

bool Request::is_local() const { return peer_->loopback && !is_forwarded(); }

bool Request::prefers_gzip() const {
  return head_->has_accept_encoding &&
         accepted_codings(header_list("Accept-Encoding").value_or("")).prefers_gzip();
}

std::string Request::query_without(std::string_view parameter) const {
  std::string kept;
  for (std::string_view rest = query_; !rest.empty();) {
    const std::string_view pair = take_field(rest, '&');
    std::string name;
    const bool is_name = append_percent_decoded(name, pair.substr(0, pair.find('=')), true);
    if (!pair.empty() && !(is_name && name == parameter)) kept.append(pair) += '&';
  }
  return kept;
}

bool Request::is_http_1_0() const { return head_->http_1_0; }

void Request::append_identity(std::string& out) const {
  const auto append_bytes = [&out](const auto& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append_bytes(std::pair(route_, response_type_.data()));  // the type as the route names it
  for (const std::optional<ArgumentValue>& argument : arguments_) {
    const std::size_t kind = argument ? argument->index() : std::variant_npos;
    const auto* const text = argument ? std::get_if<std::string_view>(&*argument) : nullptr;
    append_bytes(std::pair(kind, text == nullptr ? 0 : text->size()));
    if (text != nullptr) {
      out += *text;
    } else if (argument) {
      std::visit([&](const auto& value) { append_bytes(value); }, *argument);
    }
  }
}

std::string Request::own_origin() const {
  const bool tls = peer_->tls || ascii_iequals(header("X-Forwarded-Proto").value_or(""), "https");
  return fmt::format("{}://{}", tls ? "https" : "http", ascii_lower(head_->host));
}

}  // namespace fitgauge::http
