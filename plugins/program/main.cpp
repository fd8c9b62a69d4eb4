#include "plugins/cli/command_line.h"
#include "plugins/serve/serve.h"

int main(int count, char** words)
{
    return lightwell::run_command_line(std::vector<std::string>(words, words + count), {lightwell::add_serve});
}
