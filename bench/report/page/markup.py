# SPDX-License-Identifier: MIT
"""HTML in pieces: text is escaped, and files are in the page itself."""
import html
import urllib.parse


def escape(text):
    return html.escape(str(text), quote=True)


def tag(name, *content, **attributes):
    """`content` is markup already; attributes are escaped, and `class_` is the class."""
    given = "".join(f' {key.rstrip("_")}="{escape(value)}"' for key, value in attributes.items() if value is not None)
    return f"<{name}{given}>{''.join(content)}</{name}>"


def download(label, name, kind, text):
    """A link that saves `text` as a file, without a network."""
    return tag("a", escape(label), class_="save", download=name,
               href=f"data:{kind};charset=utf-8,{urllib.parse.quote(text, safe=' !()*,-./:;=?@_~')}")


def table(head, rows, class_=None):
    """Cells are markup, or (markup, class)."""
    def cell(name, content):
        content, style = content if isinstance(content, tuple) else (content, None)
        return tag(name, content, class_=style)
    body = "".join(tag("tr", *(cell("td", c) for c in row)) for row in rows)
    return tag("table", tag("thead", tag("tr", *(cell("th", c) for c in head))), tag("tbody", body), class_=class_)
