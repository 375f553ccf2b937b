// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/command_line.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "poise/robot/finding.h"
#include "poise/tools/commands/interruption.h"

namespace poise {
namespace {

// Returns where `middle` occurs last in a text, as the text before and after
// it.
std::optional<std::pair<std::string, std::string>> SplitAt(
    const std::string& text, const std::string& middle) {
  const size_t at = text.rfind(middle);
  if (at == std::string::npos) return std::nullopt;
  return std::pair(text.substr(0, at), text.substr(at + middle.size()));
}

// Returns the text before and after the first `middle`.
std::pair<std::string, std::string> SplitFirst(const std::string& text,
                                               const std::string& middle) {
  const size_t at = text.find(middle);
  if (at == std::string::npos) return {text, ""};
  return {text.substr(0, at), text.substr(at + middle.size())};
}

// Returns a bound in a message of CLI11, such as 1000000.000000, for a message.
std::string Bound(const std::string& digits) {
  return digits.find('.') == std::string::npos ? digits
                                               : PrintNumber(std::stod(digits));
}

bool IsFlag(const CLI::Option& option) {
  return option.get_items_expected_max() == 0;
}

// Returns the kind of number that an option expects.
std::string NumberOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.find("INT") < type.find(':') ? "a whole number" : "a number";
}

std::string Times(int n, const std::string& thing) {
  return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

// Translates the messages of CLI11 about one option.
class OptionMessage {
 public:
  // @param name  the option, as the user spelled it.
  OptionMessage(const CLI::Option& option, std::string name)
      : option_(option), name_(std::move(name)) {}

  // @param said  the message of a validator about a value.
  std::string Invalid(const std::string& said) const {
    if (said.rfind("is ", 0) == 0) return name_ + " " + said;
    if (const auto set = SplitAt(said, " not in {")) {
      std::string words = set->second.substr(0, set->second.size() - 1);
      for (size_t at = 0; (at = words.find(',', at)) != std::string::npos;) {
        words.replace(at, 1, " or ");
      }
      return Is(set->first) + "must be " + words;
    }
    const auto range = SplitAt(said, " not in range ");
    const auto bounds = SplitAt(said, " to ");
    if (!range || !bounds) return name_ + ": " + said;
    const std::string least = SplitAt(bounds->first, " ")->second;
    return Is(range->first.substr(std::string("Value ").size())) + "must be " +
           NumberOf(option_) + " from " + Bound(least) + " to " +
           Bound(bounds->second);
  }

  // @param value  what CLI11 cannot convert.
  std::string NoNumber(const std::string& value) const {
    const int n = option_.get_items_expected_max();
    return Is(value) + "must be " + (n > 1 ? "numbers" : NumberOf(option_));
  }

  // @param said  "At least 3 required but received 2".
  std::string WrongCount(const std::string& said) const {
    const auto received = SplitAt(said, " required but received ");
    const int least = option_.get_items_expected_min();
    const int most = option_.get_items_expected_max();
    const std::string wanted =
        (least < most ? "at least " : "") + Times(least, "value");
    if (!received) return name_ + " has no value, must have " + wanted;
    const int count = std::stoi(received->second);
    if (most == 1 && count > 1) {
      return name_ + " is given " + Times(count, "time") +
             ", must be given once";
    }
    return name_ + " has " + Times(count, "value") + ", must have " +
           (count > most
                ? (least < most ? "at most " : "") + Times(most, "value")
                : wanted);
  }

 private:
  std::string Is(const std::string& value) const {
    return name_ + " is " + Quoted(value) + ", ";
  }

  const CLI::Option& option_;
  const std::string name_;
};

// Returns the name of an option as the user spelled it: an option may have an
// alias.
std::string Spelled(const CLI::Option& option, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    for (const std::string& name : option.get_lnames()) {
      const std::string typed = "--" + name;
      if (word == typed || word.rfind(typed + "=", 0) == 0) return typed;
    }
  }
  return option.get_name();
}

// Returns a message about the first word that is no option, or `otherwise` if
// there is none. CLI11 reports a missing required option before such a word.
std::string SayUnknown(const CLI::App& app, const std::string& otherwise) {
  std::string stray;
  for (const std::string& word : app.remaining()) {
    if (word == "--") continue;
    if (word[0] == '-') return "option " + Quoted(word) + " is unknown";
    if (stray.empty()) stray = word;
  }
  if (stray.empty()) return otherwise;
  return Quoted(stray) + " belongs to no option, see --help";
}

// Returns the message of an error. CLI11 has its own words for each kind.
std::string Say(const CLI::App& app, const CLI::ParseError& error, int argc,
                char** argv) {
  const std::string said = error.what();
  const std::string kind = error.get_name();
  if (const auto pair = SplitAt(said, " requires ");
      pair && kind == "RequiresError") {
    return pair->first + " has an effect with " + pair->second +
           " only, give " + pair->second + " as well";
  }
  if (const auto pair = SplitAt(said, " excludes ");
      pair && kind == "ExcludesError") {
    return pair->first + " and " + pair->second +
           " exclude each other, give one of them";
  }
  if (const auto name = SplitAt(said, " is required");
      name && kind == "RequiredError") {
    return SayUnknown(app, name->first + " is missing, see --help");
  }
  const bool is_conversion = kind == "ConversionError";
  const auto [start, rest] = SplitFirst(said, ": ");
  // A conversion error is "Could not convert: --force = strong".
  const auto [name, value] =
      is_conversion ? SplitFirst(rest, " = ") : std::pair(start, rest);
  const CLI::Option* const option = app.get_option_no_throw(name);
  if (option == nullptr) return SayUnknown(app, said);
  const OptionMessage message(*option, Spelled(*option, argc, argv));
  if (is_conversion) return message.NoNumber(value);
  return kind == "ArgumentMismatch" ? message.WrongCount(value)
                                    : message.Invalid(value);
}

// Rejects a value of a flag, such as --json=maybe.
std::string RefuseNoFlag(std::string& text) {
  try {
    (void)CLI::detail::to_flag_value(text);
    return "";
  } catch (const std::exception&) {
    return "is " + Quoted(text) + ", must be true or false";
  }
}

// Rejects an empty entry of a list, as in a,,b or a,. CLI11 would leave it out.
void RefuseEmptyEntries(const CLI::App& app, int argc, char** argv) {
  std::string name;
  for (int i = 1; i < argc; ++i) {
    std::string value = argv[i];
    if (value.rfind("--", 0) == 0) {
      std::tie(name, value) = SplitFirst(value, "=");
    }
    const CLI::Option* const option = app.get_option_no_throw(name);
    if (option == nullptr || option->get_delimiter() == '\0') continue;
    const char comma = option->get_delimiter();
    // If the next word has the value, there is none here.
    if (value.empty() ||
        (value.front() != comma && value.back() != comma &&
         value.find(std::string(2, comma)) == std::string::npos)) {
      continue;
    }
    throw std::invalid_argument(
        name + " is " + Quoted(value) +
        ", must have an entry before and after each comma");
  }
}

struct Help {
  std::string text;
};

}  // namespace

void ParseCommandLine(int argc, char** argv, CLI::App* app) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.empty()) {
      throw std::invalid_argument(
          (i > 1 ? "the word after " + Quoted(argv[i - 1]) : "the first word") +
          " is empty, must have text");
    }
    if (word.size() > 3 && word.substr(0, 2) == "--" && word.back() == '=') {
      throw std::invalid_argument(Quoted(word) +
                                  " is empty, must have a value");
    }
  }
  RefuseEmptyEntries(*app, argc, argv);
  for (CLI::Option* option : app->get_options()) {
    if (IsFlag(*option)) option->check(CLI::Validator(RefuseNoFlag, ""));
  }
  try {
    app->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    throw Help{app->help()};
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument(Say(*app, error, argc, argv));
  }
  // A test of the documentation asks only whether a command line parses.
  if (std::getenv("POISE_PARSE_ONLY") != nullptr) throw Help{};
}

int RunTool(const std::string& name, const std::function<int()>& body) {
  SayIfInterrupted(name);
  try {
    int code = 0;
    try {
      code = body();
    } catch (const Help& help) {
      std::cout << help.text;
    }
    if (std::cout.flush() && std::fflush(stdout) == 0) return code;
    std::cerr << name << ": the output cannot be written\n";
  } catch (const std::exception& error) {
    std::cerr << name << ": " << OneLine(error.what()) << "\n";
  }
  return 2;
}

}  // namespace poise
