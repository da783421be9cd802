#include "db/postgres/prepared.hpp"

#include <stdexcept>

#include "db/postgres/wire.hpp"

namespace fitgauge::store::postgres {
namespace {

/// `?` and `?1` become `$1`; what stands in quotes stays.
std::string with_numbers(std::string_view sql) {
  std::string made;
  int last = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < sql.size(); ++i) {
    if (sql[i] == '\'') quoted = !quoted;
    if (sql[i] != '?' || quoted) {
      made += sql[i];
      continue;
    }
    int number = 0;
    while (i + 1 < sql.size() && sql[i + 1] >= '0' && sql[i + 1] <= '9') {
      number = 10 * number + (sql[++i] - '0');
    }
    if (number == 0) number = last + 1;
    last = std::max(last, number);
    made += '$' + std::to_string(number);
  }
  return made;
}

Oid type_of(sql::Kind kind) {
  switch (kind) {
    case sql::Kind::Integer: return kInt8;
    case sql::Kind::Text: return kText;
    case sql::Kind::Bytes: return kBytes;
  }
  return kText;
}

}  // namespace

Prepared::Prepared(Connection& connection, std::string_view sql)
    : connection_(connection), sql_(with_numbers(sql)), name_(connection.new_name()) {}

Prepared::~Prepared() { connection_.forget(name_); }

void Prepared::bind(int index, const Parameter& value) {
  const auto place = static_cast<std::size_t>(index - 1);
  if (values_.size() <= place) {
    values_.resize(place + 1);
    types_have_changed_ = true;
  }
  types_have_changed_ |= values_[place].type != value.type;
  values_[place] = value;
}

void Prepared::bind_null(int index, sql::Kind kind) { bind(index, {.type = type_of(kind)}); }

void Prepared::bind_integer(int index, std::int64_t value) {
  bind(index, {.type = kInt8, .is_null = false, .integer = value});
}

void Prepared::bind_text(int index, std::string_view value) {
  if (value.find('\0') != std::string_view::npos) {
    throw std::logic_error("PostgreSQL stores no text with a character of code 0");
  }
  bind(index, {.type = kText, .is_null = false, .bytes = value});
}

void Prepared::bind_blob(int index, std::string_view bytes) {
  bind(index, {.type = kBytes, .is_null = false, .bytes = bytes});
}

void Prepared::send() {
  if (types_have_changed_) {
    connection_.forget(name_);
    name_ = connection_.new_name();
    types_have_changed_ = false;
  }
  connection_.send(name_, sql_, values_);
}

void Prepared::run() { send(); }

bool Prepared::step() {
  if (!result_) {
    send();
    result_ = connection_.wait();
    row_ = -1;
  }
  return ++row_ < PQntuples(result_.get());
}

void Prepared::reset() noexcept { result_.reset(); }

int Prepared::columns() const { return PQnfields(result_.get()); }

bool Prepared::is_null(int column) const { return PQgetisnull(result_.get(), row_, column) != 0; }

std::string_view Prepared::text(int column) const {
  return {PQgetvalue(result_.get(), row_, column),
          static_cast<std::size_t>(PQgetlength(result_.get(), row_, column))};
}

std::int64_t Prepared::integer(int column) const { return read_number(text(column)); }

}  // namespace fitgauge::store::postgres
