#include "partwise/appearance/shapes/java_properties.h"

#include <charconv>
#include <cstdint>

namespace partwise {
namespace {

void append_utf8(std::string& text, std::uint32_t letter) {
  if (letter < 0x80) {
    text += static_cast<char>(letter);
  } else if (letter < 0x800) {
    text += static_cast<char>(0xC0 | (letter >> 6));
    text += static_cast<char>(0x80 | (letter & 0x3F));
  } else {
    text += static_cast<char>(0xE0 | (letter >> 12));
    text += static_cast<char>(0x80 | ((letter >> 6) & 0x3F));
    text += static_cast<char>(0x80 | (letter & 0x3F));
  }
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f'; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }

std::string_view without_leading_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  return text;
}

// The next logical line: a backslash before a line's end joins the next line, less its blanks.
std::string next_line(std::string_view& rest) {
  std::string line;
  rest = without_leading_blanks(rest);
  const bool comment = !rest.empty() && (rest.front() == '#' || rest.front() == '!');
  while (!rest.empty()) {
    const char c = rest.front();
    rest.remove_prefix(1);
    if (is_line_end(c)) break;
    line += c;
    if (c != '\\' || comment || rest.empty()) continue;
    const char next = rest.front();
    rest.remove_prefix(1);
    if (is_line_end(next)) {
      line.pop_back();
      if (next == '\r' && rest.starts_with('\n')) rest.remove_prefix(1);
      rest = without_leading_blanks(rest);
    } else {
      line += next;
    }
  }
  return comment ? std::string() : line;
}

// What is meant by text up to the first of `ends` that no backslash protects; the text is shortened by what was read.
std::string unescape(std::string_view& text, std::string_view ends) {
  std::string plain;
  while (!text.empty() && ends.find(text.front()) == std::string_view::npos) {
    const char c = text.front();
    text.remove_prefix(1);
    if (c != '\\' || text.empty()) {
      append_utf8(plain, static_cast<unsigned char>(c));
      continue;
    }
    const char escaped = text.front();
    text.remove_prefix(1);
    std::uint32_t letter = 0;
    if (escaped == 'u' && text.size() >= 4 &&
        std::from_chars(text.data(), text.data() + 4, letter, 16).ptr == text.data() + 4) {
      append_utf8(plain, letter);
      text.remove_prefix(4);
    } else {
      constexpr std::string_view names = "tnrf", meant = "\t\n\r\f";
      const std::size_t which = names.find(escaped);
      append_utf8(plain, static_cast<unsigned char>(which == std::string_view::npos ? escaped : meant[which]));
    }
  }
  return plain;
}

}  // namespace

std::map<std::string, std::string> read_properties(std::string_view bytes) {
  std::map<std::string, std::string> properties;
  while (!bytes.empty()) {
    const std::string line = next_line(bytes);
    std::string_view rest = line;
    const std::string key = unescape(rest, "=: \t\f");
    rest = without_leading_blanks(rest);
    if (!rest.empty() && (rest.front() == '=' || rest.front() == ':')) rest = without_leading_blanks(rest.substr(1));
    if (!key.empty()) properties[key] = unescape(rest, "");
  }
  return properties;
}

}  // namespace partwise
