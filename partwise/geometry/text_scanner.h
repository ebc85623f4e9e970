// A cursor over the text of a mesh file, for the readers of OFF, OBJ, PLY, STL and BYU, and of problem files.
//
// Tokens are runs of bytes other than blanks; blanks are space, tab, carriage return and line feed, so that the line
// ends of every system do. A backslash before a line end joins two lines (OBJ). A comment runs from a token's first
// byte `comment` to the end of its line. Numbers are read by std::from_chars: no locale, no copies, all 53 bits.
//
// Errors: InputError at "file:line". The line is counted only then, so that scanning pays nothing for it.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

namespace partwise {

class TextScanner {
 public:
  static constexpr char kNoComments = '\0';

  TextScanner(std::string file, std::string_view text, char comment = kNoComments);

  // The next token on this line or a later one; empty at the end of the text.
  std::string_view token();
  // The next token on this line; empty at its end, which is not passed.
  std::string_view token_in_line();
  // Passes over what is left of this line, and its end.
  void skip_line();
  // True when only blanks and comments are left.
  bool at_end();
  // True when this line holds no more tokens.
  bool at_line_end();

  // The next token, on this line or a later one, as a finite coordinate or as an integer. `what` names it in messages.
  double coordinate(std::string_view what);
  std::int64_t integer(std::string_view what);
  // The same of a token that was read before.
  std::int64_t to_integer(std::string_view token, std::string_view what) const;

  // Goes on from there; at most the length of the text.
  void seek(std::size_t position) { next_ = begin_ + position; }
  std::size_t position() const { return static_cast<std::size_t>(next_ - begin_); }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - next_); }
  // "file:line" of a position, and of the last token.
  std::string place(std::size_t position) const;
  std::string place() const { return place(token_start_); }
  const std::string& file() const { return file_; }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

 private:
  void skip_blanks(bool across_lines);
  std::string_view take();

  std::string file_;
  const char* begin_;
  const char* next_;
  const char* end_;
  std::size_t token_start_ = 0;
  char comment_;
};

// A token as a message can show it: short, and without bytes that a terminal would act on.
std::string shown(std::string_view token);
// What a library says of its trouble, as part of a message: one line, without quotes.
std::string shown_reason(std::string_view reason);

// Equal but for the case of ASCII letters; `lower` is in lower case.
bool equals_ignoring_case(std::string_view token, std::string_view lower);

}  // namespace partwise
