#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Says which ten tests of a run of CTest took longest."""
import sys
import xml.etree.ElementTree

for file in sys.argv[1:]:
    tests = [(float(case.get("time") or 0), case.get("name")) for case in xml.etree.ElementTree.parse(file).iter("testcase")]
    print("the slowest tests, in seconds:")
    for seconds, name in sorted(tests, reverse=True)[:10]:
        print(f"{seconds:8.1f}  {name}")
