def turcic_midha(flexura):
    pass
