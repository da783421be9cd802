; run: failed line 3: Tool not defined: tool "NOBODY"
BEGIN PGM BAD MM
TOOL CALL "NOBODY" Z S100
END PGM BAD MM
