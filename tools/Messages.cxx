// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tool.h"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <unistd.h>

#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

namespace
{
class MessageCatcher : public vtkOutputWindow
{
public:
  static MessageCatcher* New();
  vtkTypeMacro(MessageCatcher, vtkOutputWindow);
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override
  {
    if (this->FirstError.empty()) // what follows are its consequences
    {
      this->FirstError = text;
    }
  }
  void DisplayWarningText(const char* text) override
  {
    if (this->FirstWarning.empty())
    {
      this->FirstWarning = text;
    }
  }
  void DisplayGenericWarningText(const char* text) override { this->DisplayWarningText(text); }

  std::string FirstError;
  std::string FirstWarning;
};
vtkStandardNewMacro(MessageCatcher);

vtkSmartPointer<MessageCatcher> Catcher;

// VTK has it "ERROR: In FILE, line N\nCLASS (ADDRESS): TEXT\n\n". Where a reader says nothing itself, its executive
// says that it failed, and prints the request.
std::string WithoutBanner(std::string text)
{
  if (text.rfind("ERROR: In ", 0) == 0 || text.rfind("Warning: In ", 0) == 0 ||
    text.rfind("Generic Warning: In ", 0) == 0)
  {
    text.erase(0, text.find('\n') + 1);
  }
  const std::size_t object = text.find(" (0x");
  const std::size_t end = text.find("): ");
  if (text.rfind("vtk", 0) == 0 && object < end && end < text.find('\n'))
  {
    text.erase(0, end + 3);
  }
  const bool silent = text.rfind("Algorithm ", 0) == 0 && text.find("returned failure") != std::string::npos;
  return silent ? "it is damaged, or not what its name says" : text;
}
}

void tool::CatchMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  Catcher = vtkSmartPointer<MessageCatcher>::New();
  vtkOutputWindow::SetInstance(Catcher);
}

void tool::ThrowIfError(const std::string& prefix)
{
  const std::string error = std::exchange(Catcher->FirstError, std::string());
  if (!error.empty())
  {
    throw Failure(prefix + OneLine(WithoutBanner(error)));
  }
}

std::string tool::TakeWarning()
{
  return OneLine(WithoutBanner(std::exchange(Catcher->FirstWarning, std::string())));
}

std::string tool::OneLine(const std::string& text)
{
  std::string line;
  for (const char c : text)
  {
    if (!std::isspace(static_cast<unsigned char>(c)))
    {
      line += c;
    }
    else if (!line.empty() && line.back() != ' ')
    {
      line += ' ';
    }
  }
  line.resize(line.find_last_not_of(' ') + 1);
  return line;
}

void tool::PrintWarning(const std::string& text)
{
  std::fprintf(stderr, "vtkibl: warning: %s\n", text.c_str());
}

//------------------------------------------------------------------------------
tool::Progress::Progress()
{
  if (isatty(STDERR_FILENO))
  {
    this->Painter = std::thread([this] { this->Paint(); });
  }
}

void tool::Progress::Set(double share, const std::string& doing)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Share = share;
  this->Doing = doing;
}

void tool::Progress::Finish()
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Done = true;
  }
  this->Changed.notify_all();
  if (this->Painter.joinable())
  {
    this->Painter.join();
  }
}

// A thread of its own, since the longest stages say nothing while they run.
void tool::Progress::Paint()
{
  constexpr int width = 40;
  bool shown = false;
  std::unique_lock<std::mutex> lock(this->Mutex);
  auto wait = std::chrono::milliseconds(500);
  while (!this->Changed.wait_for(lock, wait, [this] { return this->Done; }))
  {
    const int full = static_cast<int>(std::lround(width * this->Share));
    std::fprintf(stderr, "\r\033[K[%s%s] %s", std::string(full, '#').c_str(), std::string(width - full, '.').c_str(),
      this->Doing.c_str());
    std::fflush(stderr);
    shown = true;
    wait = std::chrono::milliseconds(100);
  }
  if (shown)
  {
    std::fprintf(stderr, "\r\033[K");
    std::fflush(stderr);
  }
}
