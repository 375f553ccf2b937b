// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/command_line.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>

#include "poise/robot/finding.h"

namespace poise {
namespace {

// Rewrites the message of CLI11, "Could not convert: --force = strong".
std::string SayNoNumber(const std::string& message) {
  const size_t name = message.find(": ") + 2;
  const size_t value = message.find(" = ", name);
  if (value == std::string::npos) return message;
  return message.substr(name, value - name) + " is " +
         Quoted(message.substr(value + 3)) + ", must be a number";
}

// CLI11 reports a missing required option before an unknown option. Returns a
// message about the first unknown option, or `otherwise` if there is none.
std::string SayUnknown(const CLI::App& app, const std::string& otherwise) {
  for (const std::string& word : app.remaining()) {
    if (word[0] == '-') return "option " + Quoted(word) + " is unknown";
  }
  return otherwise;
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
  try {
    app->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    throw Help{app->help()};
  } catch (const CLI::ConversionError& error) {
    throw std::invalid_argument(SayNoNumber(error.what()));
  } catch (const CLI::RequiredError& error) {
    throw std::invalid_argument(SayUnknown(*app, error.what()));
  } catch (const CLI::ExtrasError& error) {
    throw std::invalid_argument(SayUnknown(*app, error.what()));
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument(error.what());
  }
  // A test of the documentation asks only whether a command line parses.
  if (std::getenv("POISE_PARSE_ONLY") != nullptr) throw Help{};
}

int RunTool(const std::string& name, const std::function<int()>& body) {
  try {
    const int code = body();
    if (std::cout.flush() && std::fflush(stdout) == 0) return code;
    std::cerr << name << ": the output cannot be written\n";
  } catch (const Help& help) {
    std::cout << help.text;
    return 0;
  } catch (const std::exception& error) {
    std::cerr << name << ": " << OneLine(error.what()) << "\n";
  }
  return 2;
}

}  // namespace poise
