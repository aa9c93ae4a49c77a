# Read when pip compiles llama-cpp-python, as the README has it: llama.cpp's library for its own
# command-line programs is left out. The Python package does not use it, and it takes half the time.
set(LLAMA_BUILD_COMMON OFF)
