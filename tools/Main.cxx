// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkibl: image-based lighting from the command line. Exit status 0: done; 1: it could not be done; 2: wrong usage.
#include "Tool.h"

#include <cstdio>
#include <exception>

const char* const tool::Generator = "vtkibl " VTKIBL_VERSION;

namespace
{
int Fail(int status, const std::string& text)
{
  std::fprintf(stderr, "vtkibl: %s\n", text.c_str());
  return status;
}
}

int main(int argc, char* argv[])
{
  CLI::App app("vtkibl turns HDR images into light: for files that other programs read, or for pictures.", "vtkibl");
  app.set_version_flag("--version", tool::Generator);
  app.require_subcommand(1);
  app.footer("Exit status: 0 done, 1 it could not be done (one line on stderr says why), 2 wrong usage.\n"
             "'vtkibl COMMAND --help' tells all about a command. VTKIBL_EGL_PLATFORM=device asks for the GPU where\n"
             "Mesa's software renderer answers first.");
  tool::AddBake(app);
  tool::AddRender(app);
  tool::AddProbe(app);
  tool::AddSphere(app);
  tool::AddInfo(app);
  tool::CatchMessages();
  try
  {
    app.parse(argc, argv); // runs the command
    return 0;
  }
  catch (const CLI::ParseError& error)
  {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
    {
      return app.exit(error); // --help, --version
    }
    const auto commands = app.get_subcommands();
    const std::string command = commands.empty() ? "vtkibl" : "vtkibl " + commands.front()->get_name();
    return Fail(2, tool::OneLine(error.what()) + " ('" + command + " --help' tells more)");
  }
  catch (const std::bad_alloc&)
  {
    return Fail(1, "too little memory");
  }
  catch (const std::exception& error)
  {
    return Fail(1, error.what());
  }
}
