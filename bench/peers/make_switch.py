#!/usr/bin/env python3
"""Writes the chain of bench/peers/chain.h as a switch with one case a leg: make_switch.py OUTPUT.cc LEGS..."""
import sys

HEAD = """// Written by bench/peers/make_switch.py.
#include "bench/peers/chain.h"

namespace peers {
namespace {

class BySwitch : public ChainPeer {
 public:
  explicit BySwitch(std::uint32_t legs) : views_(legs) {}
  void see(std::uint32_t landmark, float value) override { views_.see(landmark, value, leg_); }
  void home() override { leg_ = 0, looking_ = true; }

 protected:
  Views views_;
  std::uint32_t leg_ = 0;
  bool looking_ = true;
};
"""
ONE = """
class BySwitch{legs} final : public BySwitch {{
 public:
  BySwitch{legs}() : BySwitch({legs}) {{}}
  bool tick() override {{
    switch (leg_) {{
{cases}    }}
    return looking_;
  }}
}};
"""
CASE = """      case {leg}:
        if (!looking_) looking_ = !views_[{before}];
        else if (views_[{leg}]) leg_ = {next}, looking_ = false;
        break;
"""


def main():
    output, sizes = sys.argv[1], [int(legs) for legs in sys.argv[2:]]
    with open(output, 'w', encoding='utf-8') as out:
        out.write(HEAD)
        for legs in sizes:
            cases = ''.join(CASE.format(leg=i, before=(i - 1) % legs, next=(i + 1) % legs) for i in range(legs))
            out.write(ONE.format(legs=legs, cases=cases))
        out.write('\n}  // namespace\n\nstd::unique_ptr<ChainPeer> chain_by_switch(std::uint32_t legs) {\n  switch (legs) {\n')
        for legs in sizes:
            out.write(f'    case {legs}: return std::make_unique<BySwitch{legs}>();\n')
        out.write('    default: return nullptr;\n  }\n}\n\n}  // namespace peers\n')


main()
