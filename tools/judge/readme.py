def text(*a): return "x"
