; run: failed line 4: Tool not defined
BEGIN PGM BAD MM
TOOL CALL 0 Z
TCH PROBE 481 CAL. TOOL LENGTH ~
    Q340=+1 ~
    Q260=+100 ~
    Q341=+0
END PGM BAD MM
