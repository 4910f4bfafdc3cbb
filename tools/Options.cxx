// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tool.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

namespace
{
std::string Text(double number)
{
  std::ostringstream text;
  text << number;
  return text.str();
}

bool ParseNumber(const std::string& text, double& number)
{
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end;
}
}

CLI::Validator tool::InRange(double least, double most, bool open)
{
  const std::string range = std::string("in ") + (open ? "(" : "[") + Text(least) + ", " + Text(most) + "]";
  return CLI::Validator(
    [=](std::string& text)
    {
      double number = 0.0;
      const bool fine = ParseNumber(text, number) && number <= most && (number > least || (!open && number == least));
      return fine ? std::string() : text + " is not a number " + range;
    },
    "");
}

CLI::Option* tool::AddNumbers(CLI::App* app, const std::string& name, std::vector<double>& numbers, char separator,
  double least, double most, const std::string& form, const std::string& help)
{
  const auto parse = [=, &numbers](const std::string& text)
  {
    std::vector<double> found;
    std::istringstream parts(text);
    bool fine = !text.empty() && text.back() != separator;
    for (std::string part; fine && std::getline(parts, part, separator);)
    {
      double number = 0.0;
      fine = ParseNumber(part, number) && number >= least && number <= most;
      found.push_back(number);
    }
    if (!fine || found.size() != numbers.size())
    {
      throw CLI::ValidationError(
        name, text + " is not " + form + " with each in [" + Text(least) + ", " + Text(most) + "]");
    }
    numbers = found;
  };
  return app->add_option_function<std::string>(name, parse, help)->type_name(form);
}

CLI::Option* tool::AddSize(CLI::App* app, Size& size)
{
  const auto parse = [&size](const std::string& text)
  {
    int width = 0;
    int height = 0;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, width);
    const bool crossed = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
    const auto second = crossed ? std::from_chars(first.ptr + 1, end, height) : first;
    if (!crossed || second.ec != std::errc() || second.ptr != end || std::min(width, height) < 1 ||
      std::max(width, height) > 8192)
    {
      throw CLI::ValidationError("--size", text + " is not WIDTHxHEIGHT, 1280x800 say, with each in [1, 8192]");
    }
    size = { width, height };
  };
  return app
    ->add_option_function<std::string>("--size", parse,
      "Pixels of the picture, each in [1, 8192]; default " + std::to_string(size.Width) + "x" +
        std::to_string(size.Height))
    ->type_name("WxH");
}

std::string tool::Extension(const std::string& fileName)
{
  std::string extension = std::filesystem::path(fileName).extension().string();
  std::transform(
    extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

CLI::Validator tool::HasExtension(const std::vector<std::string>& extensions)
{
  std::string all;
  for (const std::string& extension : extensions)
  {
    all += (all.empty() ? "" : " or ") + extension;
  }
  return CLI::Validator(
    [=](std::string& fileName)
    {
      const bool fine = std::count(extensions.begin(), extensions.end(), Extension(fileName)) > 0;
      return fine ? std::string() : "'" + fileName + "' does not end in " + all;
    },
    "");
}
