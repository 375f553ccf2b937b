// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/urdf/xml_file.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <set>

#include "poise/robot/finding.h"
#include "poise/robot/text_file.h"

namespace poise {
namespace {

// Bound on the bytes of markup. TinyXML-2 uses up to 30 bytes of memory per
// byte.
constexpr size_t kMostMarkup = size_t{16} << 20;
// Bound on the attributes of an element. TinyXML-2 compares each attribute with
// all previous ones, so the time is quadratic.
constexpr size_t kMostAttributes = 100;

// Returns whether a text such as "65" or "x41" is the code point of a character
// that XML allows.
bool IsCharacter(std::string_view number) {
  const int base = number.substr(0, 1) == "x" ? 16 : 10;
  if (base == 16) number.remove_prefix(1);
  uint32_t c = 0;
  const char* end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, c, base);
  if (error != std::errc() || stop != end) return false;
  return c == '\t' || c == '\n' || c == '\r' || (c >= 0x20 && c < 0xd800) ||
         (c >= 0xe000 && c <= 0x10ffff && c != 0xfffe && c != 0xffff);
}

// Scans the text of an XML file before it is parsed.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& source)
      : text_(text), source_(source) {}

  // Throws Refusal if the text would take too much memory or time to parse.
  // Also throws for errors that TinyXML-2 accepts, such as an end tag without a
  // start tag.
  void Scan();

 private:
  [[noreturn]] void Refuse(size_t at, const std::string& what) const;

  // Returns the position after the next `closing`, searched from `at`.
  size_t SkipPast(size_t at, std::string_view closing) const;

  // Returns the position after the markup that begins at `start`.
  size_t SkipMarkup(size_t start);

  // Returns the position after a tag, which ends at the first > outside quotes.
  size_t SkipTag(size_t start);

  // Throws Refusal for characters and entities that XML forbids in a value,
  // because TinyXML-2 accepts them.
  void CheckValue(size_t start, size_t end) const;

  // Returns NAME of NAME = "value". The first quote of the value is at `quote`.
  std::string_view NameBefore(size_t quote) const;

  void CountDepth(size_t start, size_t end);

  const std::string_view text_;
  const std::string& source_;
  int depth_ = 0;  // The number of open elements.
};

void Scanner::Scan() {
  size_t markup = 0;
  size_t at = 0;
  while (at < text_.size()) {
    const size_t start = std::min(text_.find('<', at), text_.size());
    markup += start - at;
    at = start < text_.size() ? SkipMarkup(start) : start;
    // The text of a comment is not counted: TinyXML-2 stores it without
    // overhead.
    const bool is_comment = text_.substr(start, 4) == "<!--";
    markup += is_comment ? std::string_view("<!---->").size() : at - start;
    if (markup > kMostMarkup) {
      Refuse(start, "has more than 16 MiB without comments, must have less");
    }
  }
}

void Scanner::Refuse(size_t at, const std::string& what) const {
  const auto line = std::count(text_.begin(), text_.begin() + at, '\n');
  throw Refusal(source_, static_cast<int>(line) + 1, what);
}

size_t Scanner::SkipPast(size_t at, std::string_view closing) const {
  const size_t end = text_.find(closing, at);
  if (end == std::string_view::npos) {
    Refuse(at, "the file ends before '" + std::string(closing) + "'");
  }
  return end + closing.size();
}

size_t Scanner::SkipMarkup(size_t start) {
  const auto starts = [&](std::string_view opening) {
    return text_.substr(start, opening.size()) == opening;
  };
  if (starts("<!--")) return SkipPast(start + 4, "-->");
  if (starts("<![CDATA[")) return SkipPast(start, "]]>");
  if (starts("<?")) return SkipPast(start, "?>");
  if (!starts("<!")) return SkipTag(start);
  Refuse(start, "has a document type or entity declaration, must have none");
}

size_t Scanner::SkipTag(size_t start) {
  std::set<std::string_view> attributes;
  for (size_t i = start; i < text_.size(); ++i) {
    if (text_[i] == '>') {
      CountDepth(start, i);
      return i + 1;
    }
    if (text_[i] != '"' && text_[i] != '\'') continue;
    if (attributes.size() == kMostAttributes) {
      Refuse(start, "an element has more than 100 attributes, must have fewer");
    }
    const std::string_view name = NameBefore(i);
    if (!attributes.insert(name).second) {
      Refuse(i, "the attribute " + Quoted(name) + " occurs twice in a tag");
    }
    const size_t end = text_.find(text_[i], i + 1);
    if (end == std::string_view::npos) break;
    CheckValue(i + 1, end);
    if (end + 1 < text_.size() &&
        std::string_view(" \t\r\n/?>").find(text_[end + 1]) ==
            std::string_view::npos) {
      Refuse(end, "there is no space after the value of the attribute " +
                      Quoted(name));
    }
    i = end;
  }
  Refuse(start, "the file ends inside a tag");
}

void Scanner::CheckValue(size_t start, size_t end) const {
  for (size_t i = start; i < end; ++i) {
    if (text_[i] == '<') Refuse(i, "a value has <, must be &lt;");
    if (text_[i] != '&') continue;
    const std::string_view rest = text_.substr(i + 1, end - i - 1);
    const std::string_view name = rest.substr(0, rest.find(';'));
    constexpr std::string_view kEntities[] = {"amp", "lt", "gt", "quot",
                                              "apos"};
    const bool is_closed = name.size() < rest.size();
    if (is_closed && name.substr(0, 1) == "#") {
      if (IsCharacter(name.substr(1))) continue;
      Refuse(i, "a value has a character that XML forbids, " +
                    Quoted("&" + std::string(name) + ";"));
    }
    if (!is_closed || std::find(std::begin(kEntities), std::end(kEntities),
                                name) == std::end(kEntities)) {
      Refuse(i, "a value has &, must be &amp;");
    }
  }
}

std::string_view Scanner::NameBefore(size_t quote) const {
  constexpr std::string_view kBlankOrEquals = " \t\r\n=";
  const size_t last = text_.find_last_not_of(kBlankOrEquals, quote - 1);
  const size_t blank = text_.find_last_of(" \t\r\n\"'<", last);
  return text_.substr(blank + 1, last - blank);
}

void Scanner::CountDepth(size_t start, size_t end) {
  if (text_[end - 1] == '/') return;
  depth_ += text_[start + 1] == '/' ? -1 : 1;
  if (depth_ < 0) Refuse(start, "an element is closed that is not open");
}

std::string Explain(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "is empty, must be XML";
    case tinyxml2::XML_ERROR_PARSING:  // The file ends too early.
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is not closed, or its end tag has another name";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested more than 100 levels deep";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is malformed, must be name=\"value\"";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "is not XML: there is text outside the root element";
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
      return "has a <?...?> that is not at its very start";
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "is not XML: an element is malformed";
    default:
      return "is not XML";
  }
}

}  // namespace

std::unique_ptr<tinyxml2::XMLDocument> ParseXml(std::string_view text,
                                                const std::string& source) {
  ExpectText(text, source);
  Scanner(text, source).Scan();
  auto document = std::make_unique<tinyxml2::XMLDocument>();
  if (document->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw Refusal(source, document->ErrorLineNum(), Explain(*document));
  }
  return document;
}

}  // namespace poise
