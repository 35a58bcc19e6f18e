#include <iostream>

#include <cbc/version.h>

int main() { std::cout << cbc::version << '\n'; }
