// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/xml_file.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace poise {
namespace {

constexpr size_t kLongestFile = size_t{256} << 20;
// TinyXML-2 takes up to 30 bytes of memory for each of these.
constexpr size_t kMostMarkup = size_t{16} << 20;
// It compares each attribute of an element with all before it.
constexpr int kMostAttributes = 1000;

[[noreturn]] void Refuse(const std::string& source, std::string_view text,
                         size_t at, const std::string& what) {
  const auto line = 1 + std::count(text.begin(), text.begin() + at, '\n');
  throw std::invalid_argument(source + ":" + std::to_string(line) + ": " +
                              what);
}

// Where the construct that starts at `at` ends, past `closing`.
size_t SkipPast(const std::string& source, std::string_view text, size_t at,
                std::string_view closing) {
  const size_t end = text.find(closing, at);
  if (end == std::string_view::npos) {
    Refuse(source, text, at,
           "the file ends before '" + std::string(closing) + "'");
  }
  return end + closing.size();
}

// The end of a tag: the first > outside quotes.
size_t SkipTag(const std::string& source, std::string_view text, size_t at) {
  int attributes = 0;
  for (size_t i = at; i < text.size(); ++i) {
    if (text[i] == '>') return i + 1;
    if (text[i] != '"' && text[i] != '\'') continue;
    if (++attributes > kMostAttributes) {
      Refuse(source, text, at, "an element has more than 1000 attributes");
    }
    i = text.find(text[i], i + 1);
    if (i == std::string_view::npos) break;
  }
  Refuse(source, text, at, "the file ends inside a tag");
}

// Where the markup at `start` ends.
size_t SkipMarkup(const std::string& source, std::string_view text,
                  size_t start) {
  const auto starts = [&](std::string_view opening) {
    return text.substr(start, opening.size()) == opening;
  };
  if (starts("<!--")) return SkipPast(source, text, start + 4, "-->");
  if (starts("<![CDATA[")) return SkipPast(source, text, start, "]]>");
  if (starts("<?")) return SkipPast(source, text, start, "?>");
  if (!starts("<!")) return SkipTag(source, text, start);
  Refuse(source, text, start,
         "has a document type or entity declaration, must have none");
}

// What parsing would take, asked before anything is parsed.
void CheckSize(std::string_view text, const std::string& source) {
  size_t markup = 0;
  size_t at = 0;
  while (at < text.size()) {
    const size_t start = std::min(text.find('<', at), text.size());
    markup += start - at;
    at = start;
    if (start < text.size()) at = SkipMarkup(source, text, start);
    // The text of a comment takes no more memory than it is long.
    const bool is_comment = text.substr(start, 4) == "<!--";
    markup += is_comment ? std::string_view("<!---->").size() : at - start;
    if (markup > kMostMarkup) {
      Refuse(source, text, start,
             "has more than 16 MiB beside comments, must have less");
    }
  }
}

std::string Explain(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "is empty, must be XML";
    case tinyxml2::XML_ERROR_PARSING:  // The end, where a tag should be.
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is not closed, or by another name";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested more than 100 deep";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is malformed, must be name=\"value\"";
    default:
      return std::string("is not well-formed XML (") +
             tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID()) + ")";
  }
}

}  // namespace

std::string ReadFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  std::string chunk(size_t{1} << 20, '\0');
  // A folder opens, but does not read.
  while (stream.read(chunk.data(), chunk.size()), stream.gcount() > 0) {
    text.append(chunk, 0, stream.gcount());
    if (text.size() > kLongestFile) {
      throw std::invalid_argument(file.string() +
                                  ": is longer than 256 MiB, must be shorter");
    }
  }
  if (!stream.eof()) {
    throw std::invalid_argument(file.string() + ": cannot be read");
  }
  return text;
}

std::unique_ptr<tinyxml2::XMLDocument> ParseXml(std::string_view text,
                                                const std::string& source) {
  if (text.find('\0') != std::string_view::npos) {
    throw std::invalid_argument(source + ": is binary, must be UTF-8 text");
  }
  CheckSize(text, source);
  auto document = std::make_unique<tinyxml2::XMLDocument>();
  if (document->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    const int line = document->ErrorLineNum();
    throw std::invalid_argument(source +
                                (line > 0 ? ":" + std::to_string(line) : "") +
                                ": " + Explain(*document));
  }
  return document;
}

}  // namespace poise
