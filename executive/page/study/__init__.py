"""A study with participants: `python -m executive.page study FILE.toml`.

`file` says what a study is, `leading` leads one participant through it in the page, and `data`
keeps what comes of it: a journal a participant, of which the tables are made.
"""
