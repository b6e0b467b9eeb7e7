"""REXS 2.0.0 (Reusable Engineering EXchange Standard, FVA GmbH, rexs.info): designs from and to its files.

What of a family stands where in a file is data of the family (``derive.exchange.rexs``); nothing here knows one.
"""
