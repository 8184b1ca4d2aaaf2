import { View, parse } from "https://cdn.jsdelivr.net/npm/vega@6.2.0/+esm";
import { expressionInterpreter } from "https://cdn.jsdelivr.net/npm/vega-interpreter@2.0.0/+esm";
import { compile } from "https://cdn.jsdelivr.net/npm/vega-lite@6.4.1/+esm";
window.vega = { View, parse, compile, expressionInterpreter };
