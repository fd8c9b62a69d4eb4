#include "plugins/cli/command_line.h"

int main(int count, char** words)
{
    return lightwell::run_command_line(std::vector<std::string>(words, words + count));
}
