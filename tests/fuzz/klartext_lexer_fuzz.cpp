// The first half of the bytes says what to read, the second half is read: the lexer never leaves
// its block, and after a failure it stands at the end.

#include "nc/klartext/lexer.hpp"
#include "target.hpp"

using namespace fitgauge::klartext;

namespace {

void read_one(Lexer& in, unsigned what) {
  switch (what % 10) {
    case 0: in.number(); break;
    case 1: in.parameter(); break;
    case 2: in.quoted(); break;
    case 3: in.digits(65'534, "the label"); break;
    case 4: in.accept_word("CALL"); break;
    case 5: in.accept_prefix("Q"); break;
    case 6: in.expect('='); break;
    case 7: in.rest_until('/'); break;
    case 8: in.move_to(in.at() + in.letters().size()); break;
    default: in.fail_expected("nothing"); break;
  }
}

}  // namespace

void take(std::string_view bytes) {
  const std::size_t half = bytes.size() / 2;
  const std::string source(bytes.substr(half));
  Lexer in(source);
  in.open(0, source.size());
  const char* last = in.at();
  for (const char what : bytes.substr(0, half)) {
    read_one(in, static_cast<unsigned char>(what));
    require(in.at() >= last && in.at() <= in.end());
    require(!in.failure() || in.at() == in.end());
    last = in.at();
  }
  require(!free_text(source).ends_with('~') && !comment_text(source).ends_with('~'));
}
