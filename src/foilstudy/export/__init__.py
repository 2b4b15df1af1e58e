"""A realisation in the formats of other tools: one file per format behind one registry.

`formats.FORMATS` lists them, `contents.Contents` is what is exported, `write.write` writes it.
"""
